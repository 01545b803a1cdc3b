#include "harness/report/builds.hpp"

#include <pairsum/core/names.hpp>
#include "harness/rows/same_build.hpp"

namespace pairsum::harness {
namespace {

std::string revision(const environment_row& e) { return e.git + (e.dirty ? " with uncommitted changes" : ""); }

template <class Get>
void add_difference(std::string& text, const std::vector<environment_row>& known, const char* name, Get get) {
  std::set<std::string> values;
  for (const environment_row& e : known) values.insert(get(e));
  if (values.size() < 2) return;
  text += (text.empty() ? "" : ", ") + std::string(name) + " (" + join(values) + ")";
}

}  // namespace

std::size_t builds::add(const environment_row& e) {
  for (std::size_t i = 0; i < known_.size(); ++i)
    if (same_build(known_[i], e)) return i;
  known_.push_back(e);
  return known_.size() - 1;
}

void builds::measured_together(const std::set<std::size_t>& in_one_round) {
  if (in_one_round.contains(0)) together_.insert(in_one_round.begin(), in_one_round.end());
}

std::string builds::differences() const {
  std::string text;
  add_difference(text, known_, "host", [](const environment_row& e) { return e.host; });
  add_difference(text, known_, "cpu", [](const environment_row& e) { return e.cpu; });
  add_difference(text, known_, "compiler", [](const environment_row& e) { return e.compiler; });
  add_difference(text, known_, "flags", [](const environment_row& e) { return e.flags; });
  add_difference(text, known_, "git", revision);
  add_difference(text, known_, "binding", [](const environment_row& e) { return e.binding; });
  return text;
}

std::string build_name(const environment_row& e) { return e.compiler + ", git " + revision(e); }

}  // namespace pairsum::harness

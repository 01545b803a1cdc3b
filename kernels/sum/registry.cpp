#include "sum/registry.hpp"

#include <algorithm>

#include "core/names.hpp"
#include "sum/check.hpp"
#include "sum/enrolment.hpp"

namespace pairsum {
namespace {

template <class T, class Entries, class Get>
std::vector<T> distinct(const Entries& entries, Get get) {
  std::vector<T> values;
  for (const auto& e : entries) {
    const T v = get(e.what);
    if (std::ranges::find(values, v) == values.end()) values.push_back(v);
  }
  return values;
}

}  // namespace

const registry& registry::instance() {
  static const registry the_one = [] {
    registry r;
    enrol_all(r);
    return r;
  }();
  return the_one;
}

void registry::enrol_backend(const backend_traits& t, std::string unavailable) {
  backends_.push_back({t, std::move(unavailable)});
}
void registry::enrol(std::string_view backend, combination c, summation_maker make) {
  summations_.push_back({std::string(backend), std::move(c), std::move(make)});
}
void registry::enrol_reference(combination c, reference_maker make) {
  references_.push_back({std::move(c), std::move(make)});
}

std::vector<std::string> registry::interactions() const {
  return distinct<std::string>(references_, [](const combination& c) { return c.interaction; });
}
std::vector<std::string> registry::smoothings() const {
  auto names = distinct<std::string>(references_, [](const combination& c) { return c.smoothing; });
  std::erase(names, "");
  return names;
}
std::vector<std::string> registry::precisions() const {
  return distinct<std::string>(references_, [](const combination& c) { return c.precision; });
}
std::vector<int> registry::dims() const {
  return distinct<int>(references_, [](const combination& c) { return c.dim; });
}

const backend_entry& registry::find_backend(const std::string& name) const {
  std::vector<std::string_view> valid;
  for (const backend_entry& b : backends_) {
    if (b.traits.name == name) {
      if (!b.unavailable.empty()) throw error("backend " + name + " is unavailable: " + b.unavailable);
      return b;
    }
    valid.push_back(b.traits.name);
  }
  throw unknown_name("backend", name, valid);
}

template <class Entries>
const auto& registry::find(const Entries& entries, const setup& s) const {
  check_word("interaction", s.interaction, interactions());
  check_word("smoothing kernel", s.smoothing, smoothings());
  check_word("precision", s.precision, precisions());
  std::vector<std::string> built;
  for (const auto& e : entries) {
    if constexpr (requires { e.backend; })
      if (e.backend != s.backend) continue;
    const combination& c = e.what;
    if (c.interaction == s.interaction && (c.smoothing.empty() || c.smoothing == s.smoothing) && c.dim == s.dim &&
        c.precision == s.precision)
      return e;
    const std::string words = c.interaction + (c.smoothing.empty() ? "" : "/" + c.smoothing) + "/" +
                              std::to_string(c.dim) + "D/" + c.precision;
    if (std::ranges::find(built, words) == built.end()) built.push_back(words);
  }
  throw error(s.interaction + "/" + s.smoothing + "/" + std::to_string(s.dim) + "D/" + s.precision +
              " was not built; built: " + join(built));
}

std::unique_ptr<summation> registry::make_summation(const setup& s) const {
  find_backend(s.backend);
  return find(summations_, s).make(s);
}

std::unique_ptr<reference> registry::make_reference(const setup& s) const {
  check_world(s);
  return find(references_, s).make(s);
}

}  // namespace pairsum

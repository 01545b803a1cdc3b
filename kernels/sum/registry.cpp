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
  const bool known = std::ranges::any_of(backends_, [&](const backend_entry& b) { return b.traits.name == t.name; });
  if (!known) backends_.push_back({t, std::move(unavailable)});  // a second formula brings the same backends
}
void registry::enrol_missing(missing_word m) { missing_.push_back(std::move(m)); }
void registry::enrol(std::string_view backend, const combination_words& c, summation_maker make) {
  summations_.push_back({std::string(backend), c, make});
}
void registry::enrol_wrapper(const backend_traits& t, const std::string& base, summation_wrapper wrap) {
  const std::string name(t.name);
  if (std::ranges::any_of(backends_, [&](const backend_entry& b) { return b.traits.name == name; }))
    throw error("backend " + name + " is enrolled already");
  const auto entry = std::ranges::find(backends_, base, [](const backend_entry& b) { return b.traits.name; });
  if (entry == backends_.end()) throw error("backend " + name + " cannot wrap " + base + ", which is not enrolled");
  std::vector<made> wrapped;
  for (const made& m : summations_) {
    if (m.backend != base) continue;
    if (m.wrap) throw error("backend " + name + " cannot wrap " + base + ", which is a wrapper itself");
    wrapped.push_back({name, m.what, m.make, wrap, base});
  }
  backends_.push_back({t, std::string(entry->unavailable)});
  summations_.insert(summations_.end(), wrapped.begin(), wrapped.end());
}
void registry::enrol_reference(const combination_words& c, reference_maker make) { references_.push_back({c, make}); }

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
std::vector<combination> registry::formulas() const {
  return distinct<combination>(references_, [](const combination& c) { return c; });
}

template <class Words>
void registry::check_built(const std::string& kind, const std::string& word, const Words& built) const {
  for (const missing_word& m : missing_)
    if (m.kind == kind && m.word == word)
      throw error(kind + " " + word + " is not in this build; configure with -D" + m.option +
                  "=all (built: " + join(built) + ")");
  check_word(kind, word, built);
}

void registry::check_interaction(const std::string& word) const { check_built("interaction", word, interactions()); }
void registry::check_smoothing(const std::string& word) const { check_built("smoothing kernel", word, smoothings()); }
void registry::check_precision(const std::string& word) const { check_built("precision", word, precisions()); }
void registry::check_dim(int dim) const {
  std::vector<std::string> built;
  for (const int d : dims()) built.push_back(std::to_string(d));
  check_built("dimension", std::to_string(dim), built);
}
bool registry::is_smoothed(const std::string& interaction) const {
  return std::ranges::any_of(
      references_, [&](const oracle& o) { return o.what.interaction == interaction && !o.what.smoothing.empty(); });
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
  check_interaction(s.interaction);
  if (is_smoothed(s.interaction)) check_smoothing(s.smoothing);
  check_precision(s.precision);
  check_dim(s.dim);
  std::vector<std::string> built;
  bool with_another_smoothing = false;
  for (const auto& e : entries) {
    if constexpr (requires { e.backend; })
      if (e.backend != s.backend) continue;
    const combination& c = e.what;
    const bool same_place = c.interaction == s.interaction && c.dim == s.dim && c.precision == s.precision;
    if (same_place && (c.smoothing.empty() || c.smoothing == s.smoothing)) return e;
    with_another_smoothing |= same_place;
    const std::string words = c.interaction + (c.smoothing.empty() ? "" : "/" + c.smoothing) + "/" +
                              std::to_string(c.dim) + "D/" + c.precision;
    if (std::ranges::find(built, words) == built.end()) built.push_back(words);
  }
  throw error(s.interaction + "/" + s.smoothing + "/" + std::to_string(s.dim) + "D/" + s.precision + " was not built" +
              (with_another_smoothing ? ", configure with -DPAIRSUM_FORMULAS=all" : "") + "; built: " + join(built));
}

std::unique_ptr<summation> registry::make_summation(const setup& s) const {
  find_backend(s.backend);
  const made& found = find(summations_, s);
  if (!found.wrap) return found.make(s);
  setup inner = s;
  inner.backend = found.base;
  return found.wrap(found.make(inner), s);
}

std::unique_ptr<reference> registry::make_reference(const setup& s) const {
  check_world(s);
  return find(references_, s).make(s);
}

}  // namespace pairsum

#include <pairsum/sum/registry.hpp>

#include <algorithm>

#include <pairsum/core/names.hpp>
#include <pairsum/core/precision.hpp>
#include <pairsum/sum/check.hpp>
#include <pairsum/sum/summation_in.hpp>

namespace pairsum {
namespace {

template <class T, class Get>
std::vector<T> distinct(const std::vector<formula_entry>& entries, Get get) {
  std::vector<T> values;
  for (const formula_entry& e : entries) {
    const T v(get(e.words));
    if (std::ranges::find(values, v) == values.end()) values.push_back(v);
  }
  return values;
}

combination combination_of(const combination_words& w) {
  return {std::string(w.interaction), std::string(w.smoothing), w.dim, std::string(w.precision)};
}

std::string text_of(const combination_words& w) {
  const combination c = combination_of(w);
  return c.interaction + (c.smoothing.empty() ? "" : "/" + c.smoothing) + "/" + std::to_string(c.dim) + "D/" +
         c.precision;
}

}  // namespace

const registry& registry::instance() { return changeable_instance(); }
registry& registry::changeable_instance() {
  static registry the_one = [] {
    registry r;
    add_library(r);
    return r;
  }();
  return the_one;
}

void registry::add(backend_entry b) {
  const auto taken = [&](const backend_entry& other) { return other.traits.name == b.traits.name; };
  if (std::ranges::any_of(backends_, taken))
    throw error("there is a backend " + std::string(b.traits.name) + " already");
  backends_.push_back(std::move(b));
}
void registry::add(formula_entry f) {
  const combination own = combination_of(f.words);
  if (std::ranges::any_of(formulas_, [&](const formula_entry& other) { return combination_of(other.words) == own; }))
    throw error("there is a formula " + text_of(f.words) + " already");
  formulas_.push_back(f);
}
void registry::add_missing(missing_word m) { missing_.push_back(std::move(m)); }
void registry::add_wrapper(const backend_traits& t, const std::string& base, summation_wrapper wrap) {
  const std::string name(t.name);
  const auto entry = std::ranges::find(backends_, base, [](const backend_entry& b) { return b.traits.name; });
  if (entry == backends_.end()) throw error("backend " + name + " cannot wrap " + base + ": there is no such backend");
  if (std::ranges::find(wrappers_, base, &wrapper::name) != wrappers_.end())
    throw error("backend " + name + " cannot wrap " + base + ", which is a wrapper itself");
  add(backend_entry{t, entry->make, entry->unavailable});
  wrappers_.push_back({name, base, wrap});
}

std::vector<std::string> registry::interactions() const {
  return distinct<std::string>(formulas_, [](const combination_words& c) { return c.interaction; });
}
std::vector<std::string> registry::smoothings() const {
  auto names = distinct<std::string>(formulas_, [](const combination_words& c) { return c.smoothing; });
  std::erase(names, "");
  return names;
}
std::vector<std::string> registry::precisions() const {
  return distinct<std::string>(formulas_, [](const combination_words& c) { return c.precision; });
}
std::vector<int> registry::dims() const {
  return distinct<int>(formulas_, [](const combination_words& c) { return c.dim; });
}
std::vector<combination> registry::formulas() const {
  return distinct<combination>(formulas_, [](const combination_words& c) { return combination_of(c); });
}

template <class Words>
void registry::check_built(const std::string& kind, const std::string& word, const Words& built) const {
  if (std::ranges::find(built, word) != built.end()) return;
  std::vector<std::string> missing;
  for (const missing_word& m : missing_) {
    if (m.kind != kind) continue;
    if (m.word == word)
      throw unavailable(std::string(kind)
                            .append(" ")
                            .append(word)
                            .append(" is not in this build; configure with -D")
                            .append(m.option)
                            .append("=all (built: ")
                            .append(join(built))
                            .append(")"));
    missing.push_back(m.word);
  }
  // One that is not built is a better guess than a built one that is farther off.
  if (const std::string hint = hint_for(word, missing); !hint.empty() && hint_for(word, built).empty())
    throw error(std::string("unknown ")
                    .append(kind)
                    .append(" \"")
                    .append(word)
                    .append("\";")
                    .append(hint)
                    .append(" (not in this build; built: ")
                    .append(join(built))
                    .append(")"));
  throw unknown_name(kind, word, built);
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
  return std::ranges::any_of(formulas_, [&](const formula_entry& f) {
    return f.words.interaction == interaction && !f.words.smoothing.empty();
  });
}

const backend_entry& registry::find_backend(const std::string& name) const {
  std::vector<std::string_view> valid;
  for (const backend_entry& b : backends_) {
    if (b.traits.name == name) {
      if (!b.unavailable.empty()) throw unavailable("backend " + name + " is unavailable: " + b.unavailable);
      return b;
    }
    valid.push_back(b.traits.name);
  }
  throw unknown_name("backend", name, valid);
}

const formula_entry& registry::find_formula(const setup& s) const {
  check_interaction(s.interaction);
  if (is_smoothed(s.interaction)) check_smoothing(s.smoothing);
  check_precision(s.precision);
  check_dim(s.dim);
  std::vector<std::string> built;
  for (const formula_entry& f : formulas_) {
    const combination_words& c = f.words;
    const bool same_place = c.interaction == s.interaction && c.dim == s.dim && c.precision == s.precision;
    if (same_place && (c.smoothing.empty() || c.smoothing == s.smoothing)) return f;
    built.push_back(text_of(c));
  }
  throw error(s.interaction + "/" + s.smoothing + "/" + std::to_string(s.dim) + "D/" + s.precision +
              " was not built; built: " + join(built));
}

std::unique_ptr<summation> registry::make_summation(const setup& s) const {
  const backend_entry& b = find_backend(s.backend);
  if (const auto w = std::ranges::find(wrappers_, s.backend, &wrapper::name); w != wrappers_.end()) {
    setup inner = s;
    inner.backend = w->base;
    return w->wrap(make_summation(inner), s);
  }
  const formula_entry& f = find_formula(s);
  if (f.make == nullptr) throw error(text_of(f.words) + " has no sum, only a reference");
  auto made = f.make(s);
  const bool single = s.precision == precision_name<float>();
  auto joined = at_place(s.dim, single, [&]<int D, class R>() -> std::unique_ptr<summation> {
    return std::make_unique<summation_in<D, R>>(s, b.traits, b.make, cast<formula<D, R>>(std::move(made)));
  });
  if (joined == nullptr)
    throw error("this build has no formula in " + std::to_string(s.dim) + "D and " + s.precision +
                "; configure with -DPAIRSUM_DIMS=all -DPAIRSUM_PRECISIONS=all");
  return joined;
}

std::unique_ptr<reference> registry::make_reference(const setup& s) const {
  check_domain(s);
  return find_formula(s).oracle(s);
}

}  // namespace pairsum

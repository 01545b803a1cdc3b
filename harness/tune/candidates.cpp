#include "harness/tune/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include <pairsum/core/error.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/core/names.hpp>

namespace pairsum::harness {
namespace {

void check_single(const char* what, std::size_t levels) {
  if (levels != 1)
    throw error(fmt::format("tune takes one {}, not {}: what is fastest for one is asked at a time", what, levels));
}

/// The words of a point, with their keys; those that make no difference to its backend are left out.
std::vector<std::pair<std::string, std::string>> words_of(const point& p, const registry& all) {
  std::vector<std::pair<std::string, std::string>> words{{"backend", p.backend}, {"grid", p.grid}};
  if (p.M > 0) words.emplace_back("M", std::to_string(p.M));
  if (says_isa(p, all)) words.emplace_back("isa", p.isa);
  if (p.block != no_block) words.emplace_back("block", p.block);
  words.emplace_back("precision", p.precision);
  words.emplace_back("threads", std::to_string(p.threads));
  if (p.granularity != "none") words.emplace_back("granularity", p.granularity);
  return words;
}

}  // namespace

bool says_isa(const point& p, const registry& all) {
  return p.isa != scalar_isa || all.find_backend(p.backend).traits.vector;
}

std::vector<point> candidates_of(const run_request& r, const registry& all) {
  check_single("dx", r.dx.size());
  check_single("state", r.states.size());
  check_single("order", r.orders.size());
  check_single("interaction", r.interactions.size());
  check_single("smoothing", r.smoothings.size());
  check_single("integrator", r.integrators.size());
  std::vector<std::pair<std::string, std::vector<point>>> families;
  for (const world_plan& points : expand(r, all))
    for (const point& p : points) {
      auto at = std::ranges::find(families, family_of(p), [](const auto& f) { return f.first; });
      if (at == families.end()) at = families.insert(families.end(), {family_of(p), {}});
      at->second.push_back(p);
    }
  std::vector<point> order;
  for (auto& [name, points] : families) std::ranges::stable_sort(points, std::greater{}, &point::threads);
  std::size_t most = 0;
  for (const auto& [name, points] : families) most = std::max(most, points.size());
  for (std::size_t wave = 0; wave < most; ++wave)
    for (const auto& [name, points] : families)
      if (wave < points.size()) order.push_back(points[wave]);
  return order;
}

std::string family_of(const point& p) {
  return p.backend + " " + p.precision + (p.isa == scalar_isa ? "" : " " + p.isa);
}

std::string options_of(const point& p, const registry& all) {
  std::string text;
  for (const auto& [key, value] : words_of(p, all)) text += (text.empty() ? "--" : " --") + key + " " + value;
  return text;
}

std::string profile_words(const point& p, const registry& all) {
  std::string text;
  for (const auto& [key, value] : words_of(p, all)) text += (text.empty() ? "" : " ") + key + "=" + value;
  return text;
}

std::string case_options(const run_request& r) {
  std::string text = fmt::format("--case {} --dx {} --state {} --dim {} --interaction {}", r.case_name,
                                 number_text(r.dx.front()), r.states.front(), r.dim, r.interactions.front());
  if (r.smoothings.front() != no_smoothing) text += " --smoothing " + r.smoothings.front();
  const run_request standard;
  if (r.orders != standard.orders) text += " --order " + r.orders.front();
  if (r.H != standard.H) text += " --H " + number_text(r.H);
  if (r.outside != standard.outside) text += " --outside " + r.outside;
  if (r.seed != standard.seed) text += fmt::format(" --seed {}", r.seed);
  return text;
}

}  // namespace pairsum::harness

#include "harness/report/models.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/sum/registry.hpp>
#include "harness/model/cost.hpp"
#include "harness/report/self_tests.hpp"

namespace pairsum::harness {
namespace {

std::uint64_t largest_cache(const measurements& all, const std::string& environment) {
  std::uint64_t largest = 0;
  for (const environment_row& e : all.environments)
    if (e.environment == environment)
      for (const auto& [level, bytes] : e.caches) largest = std::max(largest, bytes);
  return largest;
}

formula_costs costs_of(const point& p) {
  setup s;
  s.interaction = p.interaction;
  s.smoothing = p.smoothing;
  s.precision = p.precision;
  s.grid = p.grid;
  s.dim = p.dim;
  s.constants.H = p.H;
  s.omega_low.assign(static_cast<std::size_t>(p.dim), 0.0);
  s.omega_high.assign(static_cast<std::size_t>(p.dim), 1.0);
  return registry::instance().make_reference(s)->costs();
}

}  // namespace

nlohmann::json model_entry(const measurements& all, const measured_point& p) {
  const peak_row* const peaks = peak_of(all, p, p.point.threads);
  const auto time = comparable_time(p, &phases::sum_s);
  if (peaks == nullptr || !p.work || !time) return nullptr;
  cost_question q;
  try {
    q.formula = costs_of(p.point);
    q.backend = registry::instance().find_backend(working_backend(p.point.backend)).traits;
  } catch (const error&) {  // measured by a build that has more
    return nullptr;
  }
  q.work.pairs_tested = p.work->pairs_tested;
  q.work.pairs_fluid_fluid = p.work->pairs_fluid_fluid;
  q.work.pairs_fluid_boundary = p.work->pairs_fluid_boundary;
  q.n_fluid = p.point.n_fluid;
  q.n_boundary = p.point.n_boundary;
  q.last_level_cache_bytes = largest_cache(all, peaks->environment);
  q.peaks = {peaks->bandwidth_bytes_per_s, peaks->flops_per_s};
  const cost_bound bound = bound_of(q);
  return {{"flops", bound.flops},
          {"bytes", bound.bytes},
          {"intensity", bound.intensity},
          {"bandwidth_bytes_per_s", peaks->bandwidth_bytes_per_s},
          {"flops_per_s", peaks->flops_per_s},
          {"bound_s", bound.bound_s},
          {"limited_by", bound.limited_by},
          {"share_of_bound", bound.share_of_bound(*time)},
          {"achieved_flops_per_s", bound.achieved_flops_per_s(*time)}};
}

}  // namespace pairsum::harness

#pragma once
#include <cstdint>
#include <string>

#include <pairsum/sum/backend_traits.hpp>
#include <pairsum/sum/costs.hpp>
#include <pairsum/sum/work_counts.hpp>
#include "harness/model/peaks.hpp"

namespace pairsum::harness {

/// One summation, as far as its least cost depends on it.
struct cost_question {
  formula_costs formula;
  backend_traits backend;
  work_counts work;
  std::uint64_t n_fluid = 0, n_boundary = 0;
  std::uint64_t last_level_cache_bytes = 0;
  peak_rates peaks;  ///< of the threads that sum
};

/// The least cost of a summation, and the lower bound for its time: the larger of bytes/bandwidth and flops/peak.
struct cost_bound {
  double flops = 0, bytes = 0;
  double intensity = 0;    ///< flops per byte
  double bound_s = 0;      ///< 0 if a peak is unknown
  std::string limited_by;  ///< "flops" or "bandwidth"; "" if a peak is unknown

  /// How much of a measured time the bound explains, 1 at most if the model is right.
  double share_of_bound(double time_s) const { return bound_s / time_s; }
  double achieved_flops_per_s(double time_s) const { return flops / time_s; }
};

/// The bound of the summation phase (docs/model.md says what is counted and what is left out).
cost_bound bound_of(const cost_question& q);

/// How the counted work contradicts the backend's traits; "" if it does not.
std::string contradiction(const backend_traits& declared, const work_counts& counted);

}  // namespace pairsum::harness

#include "harness/verify/compare.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace pairsum::harness {

verdict compare(const rate_table& rates, const expectation& expected) {
  verdict v;
  if (rates.names != expected.names) {
    v.ok = false;
    v.error = "the rates have other columns than the reference";
    return v;
  }
  for (std::size_t c = 0; c < expected.names.size(); ++c)
    for (std::size_t k = 0; k < expected.ids.size(); ++k)
      if (!std::isfinite(expected.value[c][k]) || !std::isfinite(expected.bound[c][k])) {
        v.ok = v.finite = false;
        v.error = fmt::format("{} of particle {} is not finite in the reference, or its bound is not",
                              expected.names[c], expected.ids[k]);
        return v;
      }
  double worst = -1;
  std::size_t failures = 0;
  for (std::size_t c = 0; c < expected.names.size(); ++c)
    for (std::size_t k = 0; k < expected.ids.size(); ++k) {
      const std::uint32_t id = expected.ids[k];
      const double rate = rates.columns[c][id], value = expected.value[c][k], bound = expected.bound[c][k];
      const double distance = std::abs(rate - value);
      const bool within = distance <= bound && std::isfinite(bound);
      failures += !within;
      double share = bound > 0 ? distance / bound : 0;
      if (!within && !(share > 1 && std::isfinite(share))) share = std::numeric_limits<double>::infinity();
      if (share <= worst) continue;
      worst = share;
      const double magnitude = expected.magnitude[c][k];
      v.max_rel_err = magnitude > 0 ? distance / magnitude : distance;
      v.bound = magnitude > 0 ? bound / magnitude : bound;
      if (!within) {
        v.ok = false;
        v.error = fmt::format("{} of particle {} is {:.17g}, the reference says {:.17g} +- {:.3g}", expected.names[c],
                              id, rate, value, bound);
      }
    }
  if (!v.ok)
    v.error +=
        fmt::format(" ({} of {} rates are out of bounds)", failures, expected.names.size() * expected.ids.size());
  return v;
}

}  // namespace pairsum::harness

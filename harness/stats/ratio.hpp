#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/stats/interval.hpp"

namespace pairsum::harness {

/// A ratio base/other with its interval (empty with too few pairs). `pairs` is 0 if it was not
/// paired.
struct ratio_estimate {
  double value = 0;
  std::optional<interval> bounds;
  std::size_t pairs = 0;
};

/// The ratio of values that were measured together: base[i] and other[i] belong to the same
/// repetition, so that what disturbs both cancels. The estimate is exp(median(log(base[i] /
/// other[i]))); its interval is the distribution-free one of the median (David & Nagaraja, Order
/// Statistics, 3rd ed., sec. 7.1), which the monotone logarithm keeps. Throws pairsum::error for
/// spans that are empty or of different length and for values that are not positive and finite.
inline ratio_estimate paired_ratio(std::span<const double> base, std::span<const double> other) {
  if (base.size() != other.size())
    throw error("a paired ratio needs as many base values as others, there are " + std::to_string(base.size()) +
                " and " + std::to_string(other.size()));
  std::vector<double> logs;
  for (std::size_t i = 0; i < base.size(); ++i) {
    if (!(base[i] > 0 && other[i] > 0)) throw error("a ratio needs positive values");
    logs.push_back(std::log(base[i] / other[i]));
  }
  ratio_estimate ratio{std::exp(median(logs)), median_interval(logs), logs.size()};
  if (ratio.bounds) {
    ratio.bounds->low = std::exp(ratio.bounds->low);
    ratio.bounds->high = std::exp(ratio.bounds->high);
  }
  return ratio;
}

/// The ratio of the medians of values that were not measured together: without an interval.
/// Throws pairsum::error for empty spans and for values that are not positive and finite.
inline ratio_estimate unpaired_ratio(std::span<const double> base, std::span<const double> other) {
  const double base_median = median(base);
  const double other_median = median(other);
  if (!(base_median > 0 && other_median > 0)) throw error("a ratio needs positive values");
  return ratio_estimate{base_median / other_median, std::nullopt, 0};
}

/// What a speedup is measured against.
struct speedup_base {
  std::string name;
  double time_s = 0;
};

/// A speedup; there is none without the name and the absolute time of its base.
class speedup {
 public:
  /// @param base what the ratio's base values are, with their median time [s]
  /// @param ratio base time over own time
  /// Throws pairsum::error if the base has no name or no positive time.
  speedup(speedup_base base, const ratio_estimate& ratio) : base_(std::move(base)), ratio_(ratio) {
    if (base_.name.empty() || !(base_.time_s > 0))
      throw error("a speedup needs a base with a name and a positive time");
  }

  const speedup_base& base() const { return base_; }
  double value() const { return ratio_.value; }
  const std::optional<interval>& bounds() const { return ratio_.bounds; }
  std::size_t pairs() const { return ratio_.pairs; }
  /// Speedup per thread: 1 is perfect, if the base ran on one thread.
  double efficiency(int threads) const { return ratio_.value / threads; }

 private:
  speedup_base base_;
  ratio_estimate ratio_;
};

}  // namespace pairsum::harness

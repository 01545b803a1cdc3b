#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {

/// The values in ascending order: the order statistics X_(1) <= ... <= X_(n).
/// Throws pairsum::error if there are none or one of them is not finite.
inline std::vector<double> order_statistics(std::span<const double> values) {
  if (values.empty()) throw error("statistics need at least one value, there are none");
  for (const double value : values)
    if (!std::isfinite(value)) throw error("statistics need finite values, one is not finite");
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// Sample median: the middle order statistic, or the mean of the two middle ones (David & Nagaraja,
/// Order Statistics, 3rd ed., sec. 1.1). Throws like order_statistics.
inline double median(std::span<const double> values) {
  const std::vector<double> sorted = order_statistics(values);
  const std::size_t middle = sorted.size() / 2;
  if (sorted.size() % 2 == 1) return sorted[middle];
  return sorted[middle - 1] + (sorted[middle] - sorted[middle - 1]) / 2;
}

}  // namespace pairsum::harness

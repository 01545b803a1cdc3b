#pragma once

#include <cmath>
#include <span>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {

/// Throws pairsum::error unless 0 < level < 1.
inline void check_level(double level) {
  if (!(level > 0 && level < 1)) throw error("a confidence level should lie between 0 and 1");
}

/// Arithmetic mean. Throws pairsum::error if there are no values or one is not finite.
inline double mean(std::span<const double> values) {
  if (values.empty()) throw error("statistics need at least one value, there are none");
  double sum = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) throw error("statistics need finite values, one is not finite");
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

/// Unbiased sample variance, with n - 1, in two passes (Chan, Golub, LeVeque, Am. Stat. 37 (1983) 242). Throws
/// pairsum::error below two values, else like mean.
inline double sample_variance(std::span<const double> values) {
  if (values.size() < 2) throw error("a variance needs at least two values");
  const double centre = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return sum / static_cast<double>(values.size() - 1);
}

}  // namespace pairsum::harness

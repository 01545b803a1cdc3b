#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "harness/stats/ratio.hpp"

namespace pairsum::harness {

/// Holm's step-down adjusted p-values, in the order of the given ones (Holm, Scand. J. Stat. 6 (1979) 65): comparing
/// each with alpha keeps the probability of even one false rejection below alpha, however the comparisons depend on
/// each other. Throws pairsum::error for a p-value outside [0, 1].
inline std::vector<double> holm_adjusted(std::span<const double> p_values) {
  for (const double p : p_values)
    if (!(p >= 0 && p <= 1)) throw error("a p-value should lie between 0 and 1");
  std::vector<std::size_t> ascending(p_values.size());
  std::iota(ascending.begin(), ascending.end(), std::size_t{0});
  std::sort(ascending.begin(), ascending.end(),
            [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0;
  for (std::size_t k = 0; k < ascending.size(); ++k) {
    const double remaining = static_cast<double>(ascending.size() - k);
    largest = std::max(largest, std::min(1.0, remaining * p_values[ascending[k]]));
    adjusted[ascending[k]] = largest;
  }
  return adjusted;
}

/// The verdict on a ratio base/other: is the other faster than its base?
enum class ratio_verdict { faster, slower, not_resolved };

constexpr std::string_view word_of(ratio_verdict v) {
  return v == ratio_verdict::faster ? "faster" : v == ratio_verdict::slower ? "slower" : "not resolved";
}

/// The verdict on one ratio of base time over other time, given its adjusted p-value: resolved if that is at most
/// `alpha`. Throws pairsum::error unless 0 < alpha < 1.
inline ratio_verdict verdict_of(const ratio_estimate& ratio, double adjusted_p, double alpha = 0.05) {
  check_level(1 - alpha);
  if (!(adjusted_p <= alpha) || ratio.value == 1) return ratio_verdict::not_resolved;
  return ratio.value > 1 ? ratio_verdict::faster : ratio_verdict::slower;
}

/// The verdicts on a family of ratios (those of one table) at family-wise error rate `alpha`. Ratios without a p-value
/// were not tested: not resolved, and not counted.
inline std::vector<ratio_verdict> verdicts_of(std::span<const ratio_estimate> family, double alpha = 0.05) {
  std::vector<double> p_values;
  for (const ratio_estimate& ratio : family)
    if (ratio.p_value) p_values.push_back(*ratio.p_value);
  const std::vector<double> adjusted = holm_adjusted(p_values);
  std::vector<ratio_verdict> verdicts;
  std::size_t tested = 0;
  for (const ratio_estimate& ratio : family)
    verdicts.push_back(verdict_of(ratio, ratio.p_value ? adjusted[tested++] : 1, alpha));
  return verdicts;
}

}  // namespace pairsum::harness

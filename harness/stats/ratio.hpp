#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/stats/interval.hpp"
#include "harness/stats/moments.hpp"
#include "harness/stats/student.hpp"

namespace pairsum::harness {

/// A ratio base/other with its interval and its p-value against a ratio of 1; both are empty with too few values.
/// `pairs` is 0 if there were none.
struct ratio_estimate {
  double value = 0;
  std::optional<interval> bounds;
  std::size_t pairs = 0;
  std::optional<double> p_value;  ///< two-sided
};

/// Fewest values a ratio's interval is made from: below, Student's t has one degree of freedom and says nothing.
inline constexpr std::size_t fewest_for_ratio = 3;

namespace detail {

inline std::vector<double> logs_of(std::span<const double> values) {
  std::vector<double> logs;
  for (const double value : values) {
    if (!(value > 0 && std::isfinite(value))) throw error("a ratio needs positive and finite values");
    logs.push_back(std::log(value));
  }
  return logs;
}

}  // namespace detail

/// The ratio of values that were measured together: base[i] and other[i] belong to the same round, so that what
/// disturbs both cancels. The estimate is exp(mean(log(base[i] / other[i]))), the geometric mean (Fleming & Wallace,
/// Comm. ACM 29 (1986) 218), which does not depend on which of the two is the base; interval and p-value
/// are Student's t on the log ratios, n - 1 degrees of freedom, at `level`, and need 3 pairs. Claims: exact if the log
/// ratios are independent and normal; nearly so if their distribution is symmetric; the interval is too narrow if they
/// are few and skewed (docs/statistics.md has figures). Throws pairsum::error for spans that are empty or of
/// different length, for values that are not positive and finite and for a level outside (0, 1).
inline ratio_estimate paired_ratio(std::span<const double> base, std::span<const double> other, double level = 0.95) {
  check_level(level);
  if (base.size() != other.size())
    throw error("a paired ratio needs as many base values as others, there are " + std::to_string(base.size()) +
                " and " + std::to_string(other.size()));
  std::vector<double> logs = detail::logs_of(base);
  const std::vector<double> other_logs = detail::logs_of(other);
  for (std::size_t i = 0; i < logs.size(); ++i) logs[i] -= other_logs[i];
  const double log_ratio = mean(logs);
  ratio_estimate r{std::exp(log_ratio), {}, logs.size(), {}};
  if (logs.size() < fewest_for_ratio) return r;
  const double n = static_cast<double>(logs.size());
  const double standard_error = std::sqrt(sample_variance(logs) / n);
  if (!(standard_error > 0)) {  // no scatter: the interval is the value itself
    r.bounds = interval{r.value, r.value, level};
    r.p_value = log_ratio == 0 ? 1 : 0;
    return r;
  }
  const double reach = student_t_quantile((1 + level) / 2, n - 1) * standard_error;
  r.bounds = interval{std::exp(log_ratio - reach), std::exp(log_ratio + reach), level};
  r.p_value = student_t_two_sided(log_ratio / standard_error, n - 1);
  return r;
}

}  // namespace pairsum::harness

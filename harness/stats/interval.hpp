#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "harness/stats/median.hpp"
#include "harness/stats/moments.hpp"

namespace pairsum::harness {

/// An interval that covers what it estimates with probability `confidence`.
struct interval {
  double low = 0;
  double high = 0;
  double confidence = 0;
};

/// Which order statistics bound the median: X_(rank) and X_(n + 1 - rank), rank from 1.
struct median_ranks {
  std::size_t rank = 0;
  double confidence = 0;
};

/// The symmetric pair of order statistics of n values with the smallest coverage >= `level`. For a
/// continuous distribution P(X_(k) < median < X_(n+1-k)) = 1 - 2 P(B <= k-1), B ~ Binomial(n, 1/2),
/// whatever the distribution (David & Nagaraja, Order Statistics, 3rd ed., sec. 7.1).
/// Empty if even [X_(1), X_(n)] does not reach the level: at 0.95 that is n < 6.
inline std::optional<median_ranks> ranks_of_median(std::size_t n, double level = 0.95) {
  check_level(level);
  std::optional<median_ranks> best;
  double log_term = -static_cast<double>(n) * std::log(2.0);  // log of C(n,0) / 2^n
  double tail = 0;
  for (std::size_t k = 1; 2 * k <= n; ++k) {
    tail += std::exp(log_term);  // now P(B <= k - 1)
    const double confidence = 1 - 2 * tail;
    if (confidence < level) break;
    best = median_ranks{k, confidence};
    log_term += std::log(static_cast<double>(n - k + 1)) - std::log(static_cast<double>(k));
  }
  return best;
}

/// Distribution-free interval for the median of the distribution the values were drawn from. If they are independent
/// but drift, it covers the median of the mean of their distributions at least as often (Hoeffding, Ann. Math. Stat. 27
/// (1956) 713), and says nothing of the undisturbed one. Empty if there are too few values for the level. Throws like
/// order_statistics.
inline std::optional<interval> median_interval(std::span<const double> values, double level = 0.95) {
  const std::vector<double> sorted = order_statistics(values);
  const std::optional<median_ranks> ranks = ranks_of_median(sorted.size(), level);
  if (!ranks) return std::nullopt;
  return interval{sorted[ranks->rank - 1], sorted[sorted.size() - ranks->rank], ranks->confidence};
}

}  // namespace pairsum::harness

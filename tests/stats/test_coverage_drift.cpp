#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "harness/stats/ratio.hpp"
#include "harness/stats/variance.hpp"
#include "synthetic_samples.hpp"

// Coverage where the values are not independent: a machine that drifts, processes that differ. Tolerances as in
// test_coverage.cpp.
namespace pairsum::harness {
namespace {

using namespace synthetic;

double small_noise(generator& random) { return 0.01 * std::normal_distribution<>()(random); }

/// A drift that both backends of a round share: pairs keep coverage and width, while the interval of the same values
/// taken apart is wide beyond use (and, since the drift is in both, holds the truth too often).
TEST(coverage, of_drifting_rounds_is_kept_by_pairs_alone) {
  for (const std::size_t n : sizes) {
    double narrow = 0, wide = 0;
    int apart = 0;
    const double share = coverage(6000 + n, [&](generator& random) {
      const pair_of_samples s = rounds(n, 1.3, small_noise, random, 0.1);
      const ratio_estimate paired = paired_ratio(s.base, s.other), unpaired = unpaired_ratio(s.base, s.other);
      narrow += std::log(paired.bounds->high / paired.bounds->low);
      wide += std::log(unpaired.bounds->high / unpaired.bounds->low);
      apart += holds(unpaired.bounds, 1.3);
      return holds(paired.bounds, 1.3);
    });
    record("paired_drifting", n, share);
    record("unpaired_drifting", n, static_cast<double>(apart) / draws);
    record("unpaired_over_paired_width", n, wide / narrow);
    EXPECT_NEAR(share, 0.95, tolerance(0.95)) << n;
    EXPECT_GT(static_cast<double>(apart) / draws, 0.99) << n;
    EXPECT_GT(wide / narrow, 8) << n;
  }
}

/// The same backends measured one after the other, under a drift they do not share: no pairing and no t mends that.
TEST(coverage, of_values_measured_one_after_the_other_under_drift_is_lost) {
  for (const std::size_t n : sizes) {
    const double share = coverage(7000 + n, [&](generator& random) {
      values base, other;
      double common = 0;
      for (std::size_t i = 0; i < 2 * n; ++i) {
        common += 0.1 * std::normal_distribution<>()(random);
        (i < n ? base : other).push_back((i < n ? 1.3 : 1.0) * std::exp(common + small_noise(random)));
      }
      return holds(unpaired_ratio(base, other).bounds, 1.3);
    });
    record("one_after_the_other", n, share);
    EXPECT_LT(share, 0.8) << n;
  }
}

/// Under a steady trend with independent noise a median interval covers the median of the mixture of the rounds'
/// distributions at least as often as stated. It does not cover the time that the undisturbed start had.
TEST(coverage, of_the_median_under_a_trend_is_that_of_the_mixture) {
  for (const std::size_t n : sizes) {
    int start = 0;
    const double middle = coverage(8000 + n, [&](generator& random) {
      values sample(n);
      for (std::size_t i = 0; i < n; ++i) {
        const double trend = 0.04 * (static_cast<double>(i) / static_cast<double>(n - 1) - 0.5);  // symmetric about 0
        sample[i] = std::exp(trend + small_noise(random));
      }
      const auto bounds = median_interval(sample);
      start += holds(bounds, std::exp(-0.02));
      return holds(bounds, 1);
    });
    record("median_trend_mixture", n, middle);
    record("median_trend_start", n, static_cast<double>(start) / draws);
    const double stated = ranks_of_median(n)->confidence;
    EXPECT_GE(middle, stated - tolerance(stated)) << n;
    EXPECT_LT(static_cast<double>(start) / draws, 0.8) << n;
  }
}

/// The negative control for the unit of a study: 10 repetitions in each of 6 processes that differ are not 60
/// independent values. Both intervals under-cover if they are taken for that, and cover with one value per process.
TEST(coverage, repetitions_of_a_process_are_not_independent) {
  const std::size_t processes = 6, repetitions = 10;
  std::normal_distribution<> normal;
  int pooled_median = 0, median_of_means = 0, means = 0;
  const double pooled = coverage(9000, [&](generator& random) {
    values base, other, base_means, other_means;
    for (std::size_t process = 0; process < processes; ++process) {
      const double base_shift = 0.03 * normal(random), other_shift = 0.03 * normal(random);
      values b, o;
      for (std::size_t i = 0; i < repetitions; ++i) {
        b.push_back(1.3 * std::exp(base_shift + small_noise(random)));
        o.push_back(std::exp(other_shift + small_noise(random)));
      }
      base.insert(base.end(), b.begin(), b.end());
      other.insert(other.end(), o.begin(), o.end());
      base_means.push_back(mean(b));
      other_means.push_back(mean(o));
    }
    const double noise_in_a_mean = std::exp(0.01 * 0.01 / 2);  // the mean of log-normal noise, for the median below
    pooled_median += holds(median_interval(other), 1);
    median_of_means += holds(median_interval(other_means), noise_in_a_mean);
    means += holds(paired_ratio(base_means, other_means).bounds, 1.3);
    return holds(paired_ratio(base, other).bounds, 1.3);
  });
  const auto share = [](int count) { return static_cast<double>(count) / draws; };
  record("pooled_60_as_independent", processes, pooled);
  record("pooled_60_median", processes, share(pooled_median));
  record("one_value_per_process", processes, share(means));
  record("one_value_per_process_median", processes, share(median_of_means));
  EXPECT_LT(pooled, 0.7) << "the check finds out a wrong unit";
  EXPECT_LT(share(pooled_median), 0.7);
  EXPECT_NEAR(share(means), 0.95, tolerance(0.95));
  const double stated = ranks_of_median(processes)->confidence;
  EXPECT_NEAR(share(median_of_means), stated, tolerance(stated));
}

}  // namespace
}  // namespace pairsum::harness

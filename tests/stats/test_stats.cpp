#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "harness/stats/interval.hpp"
#include "harness/stats/median.hpp"
#include "harness/stats/ratio.hpp"

namespace pairsum::harness {
namespace {

using values = std::vector<double>;

TEST(median, of_known_samples) {
  EXPECT_EQ(median(values{3}), 3);
  EXPECT_EQ(median(values{5, 1, 3}), 3);
  EXPECT_EQ(median(values{4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median(values{1e300, 1.5e308, 1.7e308, 1e300}), 1e300 + (1.5e308 - 1e300) / 2);
}

TEST(median, rejects_what_has_no_median) {
  EXPECT_THROW(median(values{}), error);
  EXPECT_THROW(median(values{1, std::nan(""), 2}), error);
  EXPECT_THROW(median(values{std::numeric_limits<double>::infinity()}), error);
}

TEST(interval, needs_six_values) {
  EXPECT_FALSE(median_interval(values{1, 2, 3, 4, 5}));
  const auto bounds = median_interval(values{6, 1, 5, 2, 4, 3});
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->low, 1);
  EXPECT_EQ(bounds->high, 6);
  EXPECT_DOUBLE_EQ(bounds->confidence, 0.96875);
}

/// Ranks and confidences as tabulated for the sign test at the 95 % level.
TEST(interval, ranks_of_known_sizes) {
  const struct {
    std::size_t n, rank;
    double confidence;
  } known[] = {{7, 1, 0.984375},     {8, 1, 0.9921875},      {9, 2, 0.9609375},
               {10, 2, 0.978515625}, {12, 3, 0.96142578125}, {20, 6, 0.95861053466796875}};
  for (const auto& k : known) {
    const auto ranks = ranks_of_median(k.n);
    ASSERT_TRUE(ranks) << k.n;
    EXPECT_EQ(ranks->rank, k.rank) << k.n;
    EXPECT_NEAR(ranks->confidence, k.confidence, 1e-12) << k.n;
  }
}

TEST(interval, many_values_are_near_the_normal_approximation) {
  const std::size_t n = 5000;
  const auto ranks = ranks_of_median(n);
  ASSERT_TRUE(ranks);
  const double normal = n / 2.0 - 1.96 * std::sqrt(n) / 2;
  EXPECT_NEAR(static_cast<double>(ranks->rank), normal, 2);
  EXPECT_GE(ranks->confidence, 0.95);
  EXPECT_LT(ranks->confidence, 0.955);
}

TEST(interval, rejects_bad_input) {
  EXPECT_THROW(median_interval(values{}), error);
  EXPECT_THROW(median_interval(values{1, 2, 3, 4, 5, std::nan("")}), error);
  EXPECT_THROW(ranks_of_median(10, 1.0), error);
  EXPECT_THROW(ranks_of_median(10, 0.0), error);
}

TEST(interval, covers_the_median_of_a_skewed_distribution) {
  std::mt19937_64 random(20240607);
  std::lognormal_distribution<double> skewed(0.0, 1.5);  // its median is 1
  for (const std::size_t n : {std::size_t{6}, std::size_t{9}, std::size_t{25}}) {
    int covered = 0;
    const int draws = 2000;
    for (int draw = 0; draw < draws; ++draw) {
      values sample(n);
      for (double& value : sample) value = skewed(random);
      const auto bounds = median_interval(sample);
      ASSERT_TRUE(bounds);
      covered += bounds->low <= 1 && 1 <= bounds->high;
    }
    const double coverage = static_cast<double>(covered) / draws;
    EXPECT_GE(coverage, 0.94) << n;
    EXPECT_LE(coverage, 1.0) << n;
    EXPECT_NEAR(coverage, ranks_of_median(n)->confidence, 0.02) << n;
  }
}

TEST(ratio, of_known_pairs) {
  const ratio_estimate r = paired_ratio(values{2, 4, 9}, values{1, 1, 3});
  EXPECT_DOUBLE_EQ(r.value, 3);
  EXPECT_EQ(r.pairs, 3u);
  EXPECT_FALSE(r.bounds);
  EXPECT_DOUBLE_EQ(paired_ratio(values{2, 8}, values{1, 1}).value, 4);  // geometric mean of 2 and 8
}

TEST(ratio, what_disturbs_both_cancels) {
  const values base{2, 20, 200, 4, 6, 2.2};
  const values other{1, 10, 100, 2, 3, 1.0};
  const ratio_estimate r = paired_ratio(base, other);
  EXPECT_DOUBLE_EQ(r.value, 2);
  ASSERT_TRUE(r.bounds);
  EXPECT_DOUBLE_EQ(r.bounds->low, 2);
  EXPECT_DOUBLE_EQ(r.bounds->high, 2.2);
  EXPECT_DOUBLE_EQ(r.bounds->confidence, 0.96875);
}

TEST(ratio, the_swapped_ratio_is_the_reciprocal) {
  const values a{2, 3, 5, 7, 11, 13}, b{1, 4, 2, 9, 3, 8};
  const ratio_estimate ab = paired_ratio(a, b), ba = paired_ratio(b, a);
  EXPECT_NEAR(ab.value * ba.value, 1, 1e-14);
  EXPECT_NEAR(ab.bounds->low * ba.bounds->high, 1, 1e-14);
}

TEST(ratio, rejects_bad_input) {
  EXPECT_THROW(paired_ratio(values{}, values{}), error);
  EXPECT_THROW(paired_ratio(values{1, 2}, values{1}), error);
  EXPECT_THROW(paired_ratio(values{1, 0}, values{1, 1}), error);
  EXPECT_THROW(paired_ratio(values{1, 1}, values{1, -1}), error);
  EXPECT_THROW(unpaired_ratio(values{}, values{1}), error);
  EXPECT_THROW(unpaired_ratio(values{1}, values{0}), error);
}

TEST(ratio, unpaired_has_no_interval) {
  const ratio_estimate r = unpaired_ratio(values{2, 4, 6}, values{1, 2, 3, 2});
  EXPECT_DOUBLE_EQ(r.value, 2);
  EXPECT_FALSE(r.bounds);
  EXPECT_EQ(r.pairs, 0u);
}

TEST(speedup, has_its_base) {
  const ratio_estimate r = paired_ratio(values{2, 4}, values{1, 2});
  const speedup s(speedup_base{"naive M=6", 3.0}, r);
  EXPECT_EQ(s.base().name, "naive M=6");
  EXPECT_EQ(s.base().time_s, 3.0);
  EXPECT_DOUBLE_EQ(s.value(), 2);
  EXPECT_DOUBLE_EQ(s.efficiency(4), 0.5);
  EXPECT_EQ(s.pairs(), 2u);
  static_assert(!std::is_default_constructible_v<speedup>);
  static_assert(!std::is_constructible_v<speedup, ratio_estimate>);
  static_assert(!std::is_constructible_v<speedup, double>);
  EXPECT_THROW(speedup(speedup_base{"", 3.0}, r), error);
  EXPECT_THROW(speedup(speedup_base{"naive", 0.0}, r), error);
}

}  // namespace
}  // namespace pairsum::harness

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "harness/stats/interval.hpp"
#include "harness/stats/median.hpp"

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

}  // namespace
}  // namespace pairsum::harness

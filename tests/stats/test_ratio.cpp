#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "harness/stats/speedup.hpp"

namespace pairsum::harness {
namespace {

using values = std::vector<double>;

/// Values with these logarithms.
values with_logs(const values& logs) {
  values made;
  for (const double log : logs) made.push_back(std::exp(log));
  return made;
}

TEST(ratio, is_the_geometric_mean_whichever_is_the_base) {
  EXPECT_NEAR(paired_ratio(values{2, 8}, values{1, 1}).value, 4, 1e-14);
  EXPECT_NEAR(paired_ratio(values{1, 1}, values{2, 8}).value, 0.25, 1e-15);
  EXPECT_NEAR(paired_ratio(values{2, 0.5}, values{1, 1}).value, 1, 1e-15) << "the arithmetic mean says 1.25";
  EXPECT_EQ(paired_ratio(values{2, 4, 9}, values{1, 1, 3}).pairs, 3u);
}

/// Log ratios 1, 2, 3: mean 2, standard error 1/sqrt(3), 2 degrees of freedom, whose distribution is closed.
TEST(ratio, interval_and_p_value_of_known_pairs) {
  const ratio_estimate r = paired_ratio(with_logs({1, 2, 3}), values{1, 1, 1});
  ASSERT_TRUE(r.bounds && r.p_value);
  EXPECT_NEAR(std::log(r.value), 2, 1e-14);
  EXPECT_NEAR(std::log(r.bounds->low), 2 - 4.302653 / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(std::log(r.bounds->high), 2 + 4.302653 / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(r.bounds->confidence, 0.95);
  const double t = 2 * std::sqrt(3.0);
  EXPECT_NEAR(*r.p_value, 1 - t / std::sqrt(2 + t * t), 1e-14);
  const ratio_estimate wider = paired_ratio(with_logs({1, 2, 3}), values{1, 1, 1}, 0.99);
  EXPECT_NEAR(std::log(wider.bounds->high), 2 + 9.924843 / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(wider.bounds->confidence, 0.99);
}

TEST(ratio, the_interval_holds_1_exactly_if_the_p_value_is_above_its_complement) {
  for (const double shift : {-0.9, -0.3, 0.0, 0.2, 0.5, 0.8, 1.5}) {
    const ratio_estimate r =
        paired_ratio(with_logs({shift, shift + 0.5, shift - 0.4, shift + 0.1}), values{1, 1, 1, 1});
    EXPECT_EQ(r.bounds->low <= 1 && 1 <= r.bounds->high, *r.p_value >= 0.05) << shift;
  }
}

TEST(ratio, two_pairs_say_nothing_of_their_scatter) {
  const ratio_estimate r = paired_ratio(values{2, 4}, values{1, 1});
  EXPECT_FALSE(r.bounds);
  EXPECT_FALSE(r.p_value);
}

TEST(ratio, what_disturbs_both_cancels) {
  const values base{2, 20, 200, 4, 6, 2.2};
  const values other{1, 10, 100, 2, 3, 1.1};
  const ratio_estimate r = paired_ratio(base, other);
  EXPECT_NEAR(r.value, 2, 1e-14);
  ASSERT_TRUE(r.bounds);
  EXPECT_NEAR(r.bounds->low, 2, 1e-13);
  EXPECT_NEAR(r.bounds->high, 2, 1e-13);
  const ratio_estimate apart = unpaired_ratio(base, other);
  EXPECT_NEAR(apart.value, 2, 1e-14);
  EXPECT_LT(apart.bounds->low, 0.3);
  EXPECT_GT(apart.bounds->high, 12);
}

TEST(ratio, without_scatter_the_interval_is_the_value) {
  const ratio_estimate same = paired_ratio(values{3, 3, 3}, values{3, 3, 3});
  EXPECT_EQ(same.bounds->low, 1);
  EXPECT_EQ(same.bounds->high, 1);
  EXPECT_EQ(*same.p_value, 1);
  const ratio_estimate twice = unpaired_ratio(values{2, 2, 2}, values{1, 1, 1});
  EXPECT_EQ(twice.bounds->low, twice.value);
  EXPECT_EQ(*twice.p_value, 0);
}

TEST(ratio, the_swapped_ratio_is_the_reciprocal) {
  const values a{2, 3, 5, 7, 11, 13}, b{1, 4, 2, 9, 3, 8};
  for (const auto& estimate : {paired_ratio, unpaired_ratio}) {
    const ratio_estimate ab = estimate(a, b, 0.95), ba = estimate(b, a, 0.95);
    EXPECT_NEAR(ab.value * ba.value, 1, 1e-14);
    EXPECT_NEAR(ab.bounds->low * ba.bounds->high, 1, 1e-13);
    EXPECT_NEAR(*ab.p_value, *ba.p_value, 1e-14);
  }
}

TEST(ratio, rejects_bad_input) {
  EXPECT_THROW(paired_ratio(values{}, values{}), error);
  EXPECT_THROW(paired_ratio(values{1, 2}, values{1}), error);
  EXPECT_THROW(paired_ratio(values{1, 0}, values{1, 1}), error);
  EXPECT_THROW(paired_ratio(values{1, 1}, values{1, -1}), error);
  EXPECT_THROW(paired_ratio(values{1, std::numeric_limits<double>::infinity()}, values{1, 1}), error);
  EXPECT_THROW(paired_ratio(values{1}, values{1}, 1.0), error);
  EXPECT_THROW(unpaired_ratio(values{1}, values{1}, 0.0), error);
  EXPECT_THROW(unpaired_ratio(values{}, values{1}), error);
  EXPECT_THROW(unpaired_ratio(values{1}, values{0}), error);
}

/// Equal spread and number: 4 degrees of freedom; no spread in one: those of the other, 2.
TEST(ratio, unpaired_has_the_interval_of_welch) {
  const values base = with_logs({1, 2, 3});
  const ratio_estimate r = unpaired_ratio(base, with_logs({0, -1, 1}));
  ASSERT_TRUE(r.bounds && r.p_value);
  EXPECT_EQ(r.pairs, 0u);
  const double error_of_both = std::sqrt(2.0 / 3);
  EXPECT_NEAR(std::log(r.value), 2, 1e-14);
  EXPECT_NEAR(std::log(r.bounds->low), 2 - 2.776445 * error_of_both, 1e-6);
  EXPECT_NEAR(std::log(r.bounds->high), 2 + 2.776445 * error_of_both, 1e-6);
  const double t = 2 / error_of_both, q = 1 + t * t / 4;
  EXPECT_NEAR(*r.p_value, 1 - 3 * t / (4 * std::sqrt(q)) * (1 - t * t / (12 * q)), 1e-12);
  const ratio_estimate still = unpaired_ratio(base, values{1, 1, 1, 1});
  EXPECT_NEAR(std::log(still.bounds->high), 2 + 4.302653 / std::sqrt(3.0), 1e-6);
}

TEST(ratio, unpaired_needs_three_values_of_each) {
  for (const auto& [base, other] :
       {std::pair{values{1, 2}, values{1, 2, 3}}, std::pair{values{1, 2, 3}, values{1, 2}}}) {
    EXPECT_FALSE(unpaired_ratio(base, other).bounds);
    EXPECT_FALSE(unpaired_ratio(base, other).p_value);
  }
}

TEST(speedup, has_its_base) {
  const ratio_estimate r = paired_ratio(values{2, 4}, values{1, 2});
  const speedup s(speedup_base{"naive M=6", 3.0}, r);
  EXPECT_EQ(s.base().name, "naive M=6");
  EXPECT_EQ(s.base().time_s, 3.0);
  EXPECT_NEAR(s.value(), 2, 1e-14);
  EXPECT_NEAR(s.efficiency(4), 0.5, 1e-14);
  EXPECT_EQ(s.pairs(), 2u);
  static_assert(!std::is_default_constructible_v<speedup>);
  static_assert(!std::is_constructible_v<speedup, ratio_estimate>);
  static_assert(!std::is_constructible_v<speedup, double>);
  EXPECT_THROW(speedup(speedup_base{"", 3.0}, r), error);
  EXPECT_THROW(speedup(speedup_base{"naive", 0.0}, r), error);
}

}  // namespace
}  // namespace pairsum::harness

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "harness/stats/holm.hpp"
#include "synthetic_samples.hpp"

namespace pairsum::harness {
namespace {

using namespace synthetic;

void expect_near(const values& found, const values& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-15) << i;
}

TEST(holm, adjusts_known_p_values) {
  expect_near(holm_adjusted(values{0.01, 0.04, 0.03, 0.005}), {0.03, 0.06, 0.06, 0.02});
  expect_near(holm_adjusted(values{0.02}), {0.02});
  expect_near(holm_adjusted(values{0.6, 0.5, 0.9}), {1, 1, 1});
  EXPECT_TRUE(holm_adjusted(values{}).empty());
}

TEST(holm, rejects_what_is_no_p_value) {
  EXPECT_THROW(holm_adjusted(values{0.1, -0.1}), error);
  EXPECT_THROW(holm_adjusted(values{1.1}), error);
  EXPECT_THROW(holm_adjusted(values{std::nan("")}), error);
}

TEST(verdict, has_its_word) {
  const ratio_estimate faster{1.2, {}, 6, 0.01}, slower{0.8, {}, 6, 0.01};
  EXPECT_EQ(word_of(verdict_of(faster, 0.03)), "faster");
  EXPECT_EQ(word_of(verdict_of(slower, 0.03)), "slower");
  EXPECT_EQ(word_of(verdict_of(faster, 0.06)), "not resolved");
  EXPECT_EQ(word_of(verdict_of(faster, 0.06, 0.1)), "faster");
  EXPECT_THROW(verdict_of(faster, 0.03, 0.0), error);
}

TEST(verdict, of_a_family_counts_those_that_were_tested) {
  const ratio_estimate untested{1.5, {}, 2, {}}, resolved{1.2, {}, 6, 0.02}, other{0.9, {}, 6, 0.04};
  EXPECT_EQ(verdicts_of(std::vector{untested, resolved, other}),
            (std::vector{ratio_verdict::not_resolved, ratio_verdict::faster, ratio_verdict::slower}));
  EXPECT_EQ(verdicts_of(std::vector{resolved, other, ratio_estimate{1, {}, 6, 0.5}}),
            (std::vector(3, ratio_verdict::not_resolved)))
      << "three times 0.02 is above 0.05";
}

struct errors {
  double with_holm, alone;  ///< shares of families with a false verdict
};

/// Families of 10 comparisons of equals in 6 rounds, against bases of their own or one that all share.
errors family_wise_errors(bool same_base, unsigned seed) {
  generator random(seed);
  int with_holm = 0, alone = 0;
  for (int family = 0; family < draws; ++family) {
    std::vector<ratio_estimate> ratios;
    const values shared = rounds(6, 1, log_normal_noise, random).base;
    for (int i = 0; i < 10; ++i) {
      const pair_of_samples s = rounds(6, 1, log_normal_noise, random);
      ratios.push_back(paired_ratio(same_base ? shared : s.base, s.other));
    }
    bool is_wrong = false, is_wrong_alone = false;
    for (const ratio_verdict v : verdicts_of(ratios)) is_wrong = is_wrong || v != ratio_verdict::not_resolved;
    for (const ratio_estimate& r : ratios) is_wrong_alone = is_wrong_alone || *r.p_value <= 0.05;
    with_holm += is_wrong;
    alone += is_wrong_alone;
  }
  return {static_cast<double>(with_holm) / draws, static_cast<double>(alone) / draws};
}

TEST(holm, keeps_the_family_wise_error_below_its_level) {
  const errors independent = family_wise_errors(false, 21), dependent = family_wise_errors(true, 22);
  RecordProperty("independent", std::to_string(independent.with_holm));
  RecordProperty("independent_alone", std::to_string(independent.alone));
  RecordProperty("same_base", std::to_string(dependent.with_holm));
  RecordProperty("same_base_alone", std::to_string(dependent.alone));
  EXPECT_LE(independent.with_holm, 0.05 + tolerance(0.05));
  EXPECT_LE(dependent.with_holm, 0.05 + tolerance(0.05));
  EXPECT_GE(independent.with_holm, 0.05 - tolerance(0.05)) << "the tests reject at all";
  EXPECT_NEAR(independent.alone, 1 - std::pow(0.95, 10), tolerance(0.4)) << "without the correction it is far above";
  EXPECT_GT(dependent.alone, 0.15);
}

/// A difference of 5 % under noise of 1 % is found among nine comparisons of equals, and these stay unresolved.
TEST(holm, finds_the_one_that_differs) {
  const double share = coverage(23, [](generator& random) {
    const auto noise = [](generator& g) { return 0.01 * std::normal_distribution<>()(g); };
    std::vector<ratio_estimate> ratios;
    for (int i = 0; i < 10; ++i) {
      const pair_of_samples s = rounds(6, i == 4 ? 1.05 : 1.0, noise, random, 0.1);
      ratios.push_back(paired_ratio(s.base, s.other));
    }
    return verdicts_of(ratios)[4] == ratio_verdict::faster;
  });
  RecordProperty("power", std::to_string(share));
  EXPECT_GT(share, 0.8);
}

}  // namespace
}  // namespace pairsum::harness

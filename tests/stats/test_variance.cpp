#include <gtest/gtest.h>

#include <cmath>

#include "harness/stats/variance.hpp"
#include "synthetic_samples.hpp"

namespace pairsum::harness {
namespace {

using groups = std::vector<std::vector<double>>;

TEST(variance, components_of_known_groups) {
  const variance_components balanced = components_of_variance(groups{{1, 3}, {5, 7}});
  EXPECT_NEAR(*balanced.within, std::sqrt(2.0) / 4, 1e-15);
  EXPECT_NEAR(*balanced.between, std::sqrt(7.0) / 4, 1e-15);  // mean squares 16 and 2, (16 - 2) / 2
  const variance_components unbalanced = components_of_variance(groups{{1, 3}, {5}});
  EXPECT_NEAR(*unbalanced.within, std::sqrt(2.0) / 3.5, 1e-15);
  EXPECT_NEAR(*unbalanced.between, std::sqrt(3.0) / 3.5, 1e-15);  // mean squares 6 and 2, (6 - 2) / (4 / 3)
}

TEST(variance, a_negative_estimate_is_zero) {
  const variance_components same = components_of_variance(groups{{1, 3}, {1, 3}, {1, 3}});
  EXPECT_EQ(*same.between, 0);
  EXPECT_GT(*same.within, 0);
}

TEST(variance, what_cannot_be_known_is_empty) {
  const variance_components single = components_of_variance(groups{{1}, {3}, {5}});
  EXPECT_FALSE(single.within);
  EXPECT_NEAR(*single.between, 2.0 / 3, 1e-15);
  const variance_components one = components_of_variance(groups{{1, 3}});
  EXPECT_FALSE(one.between);
  EXPECT_NEAR(*one.within, std::sqrt(2.0) / 2, 1e-15);
}

TEST(variance, is_relative_to_the_mean) {
  const variance_components a = components_of_variance(groups{{1, 3}, {5, 7, 8}});
  const variance_components b = components_of_variance(groups{{1e-3, 3e-3}, {5e-3, 7e-3, 8e-3}});
  EXPECT_NEAR(*a.between, *b.between, 1e-14);
  EXPECT_NEAR(*a.within, *b.within, 1e-14);
}

TEST(variance, rejects_bad_input) {
  EXPECT_THROW(components_of_variance(groups{}), error);
  EXPECT_THROW(components_of_variance(groups{{1, 2}, {}}), error);
  EXPECT_THROW(components_of_variance(groups{{1, -2}}), error);
  EXPECT_THROW(components_of_variance(groups{{1, std::nan("")}}), error);
}

/// The mean over 2000 studies of the squared components is the truth. The tolerance is four standard errors of that
/// mean; the estimate's own spread is measured.
TEST(variance, recovers_its_components) {
  const double between = 0.05, within = 0.02;
  for (const bool is_balanced : {true, false}) {
    synthetic::generator random(is_balanced ? 11 : 12);
    std::normal_distribution<> normal;
    std::vector<double> found_between, found_within;
    for (int draw = 0; draw < synthetic::draws; ++draw) {
      groups study;
      for (std::size_t process = 0; process < 10; ++process) {
        const double shift = between * normal(random);
        std::vector<double> group;
        for (std::size_t i = 0; i < (is_balanced ? 5 : 1 + process % 4 * 3); ++i)
          group.push_back(1 + shift + within * normal(random));
        study.push_back(group);
      }
      const variance_components found = components_of_variance(study);
      found_between.push_back(*found.between * *found.between);
      found_within.push_back(*found.within * *found.within);
    }
    const auto check = [&](const std::vector<double>& squares, double truth) {
      const double standard_error = std::sqrt(sample_variance(squares) / synthetic::draws);
      // Dividing by a mean that was itself estimated, of relative variance 0.05^2 / 10, adds a part in a thousand.
      EXPECT_NEAR(mean(squares), truth * truth, 4 * standard_error + 1e-3 * truth * truth) << is_balanced;
    };
    check(found_between, between);
    check(found_within, within);
  }
}

}  // namespace
}  // namespace pairsum::harness

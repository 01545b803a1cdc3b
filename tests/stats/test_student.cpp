#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include <pairsum/core/error.hpp>
#include "harness/stats/student.hpp"

namespace pairsum::harness {
namespace {

/// As printed in the usual tables (Abramowitz & Stegun, table 26.10).
TEST(student, tabulated_quantiles) {
  const struct {
    double probability, freedom, t;
  } known[] = {{0.975, 1, 12.70620}, {0.975, 2, 4.30265}, {0.975, 5, 2.57058},  {0.975, 10, 2.22814},
               {0.975, 30, 2.04227}, {0.95, 5, 2.01505},  {0.995, 5, 4.03214},  {0.995, 10, 3.16927},
               {0.9, 1, 3.07768},    {0.75, 1, 1},        {0.9995, 2, 31.59905}};
  for (const auto& k : known) {
    EXPECT_NEAR(student_t_quantile(k.probability, k.freedom), k.t, 6e-6 * k.t) << k.probability << " " << k.freedom;
    EXPECT_NEAR(student_t_quantile(1 - k.probability, k.freedom), -k.t, 6e-6 * k.t);
  }
  EXPECT_EQ(student_t_quantile(0.5, 3), 0);
  EXPECT_NEAR(student_t_quantile(0.975, 1e7), 1.959964, 1e-5) << "the normal distribution's";
}

/// With 1 and 2 degrees of freedom the distribution is closed.
TEST(student, closed_forms) {
  for (const double t : {-40.0, -3.0, -0.5, -1e-6, 0.0, 1e-3, 0.9, 1.0, 1.1, 1.42, 5.0, 1e3}) {
    EXPECT_NEAR(student_t_cdf(t, 1), 0.5 + std::atan(t) / std::numbers::pi, 1e-14) << t;
    EXPECT_NEAR(student_t_cdf(t, 2), 0.5 + t / (2 * std::sqrt(2 + t * t)), 1e-14) << t;
    EXPECT_NEAR(student_t_two_sided(t, 2), 1 - std::abs(t) / std::sqrt(2 + t * t), 1e-14) << t;
  }
}

TEST(student, small_p_values_do_not_cancel) {
  const double t = 1e9;  // 2 degrees of freedom: 1 - 1/sqrt(1 + 2/t^2) = 1/t^2
  EXPECT_NEAR(student_t_two_sided(t, 2), 1e-18, 1e-28);
  EXPECT_EQ(student_t_two_sided(std::numeric_limits<double>::infinity(), 5), 0);
  EXPECT_EQ(student_t_cdf(-std::numeric_limits<double>::infinity(), 5), 0);
}

TEST(student, quantile_and_cdf_are_inverse) {
  for (const double freedom : {1.0, 1.5, 2.7, 5.0, 19.0, 400.0})
    for (const double probability : {1e-9, 0.001, 0.3, 0.5, 0.6, 0.975, 0.999999})
      EXPECT_NEAR(student_t_cdf(student_t_quantile(probability, freedom), freedom), probability, 1e-12 * probability)
          << probability << " " << freedom;
}

TEST(student, rejects_bad_input) {
  EXPECT_THROW(student_t_cdf(1, 0), error);
  EXPECT_THROW(student_t_cdf(1, std::numeric_limits<double>::infinity()), error);
  EXPECT_THROW(student_t_cdf(std::nan(""), 3), error);
  EXPECT_THROW(student_t_quantile(0, 3), error);
  EXPECT_THROW(student_t_quantile(1, 3), error);
  EXPECT_THROW(student_t_quantile(std::nan(""), 3), error);
  EXPECT_THROW(student_t_quantile(0.5, -1), error);
}

}  // namespace
}  // namespace pairsum::harness

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "vector/vector_kernels.hpp"

// Roots lane by lane, by the instruction set this is compiled for.
#if PAIRSUM_LANES
namespace pairsum {
namespace {

template <class R>
R root(R a) {
  const lane_tag<R> d;
  return hn::GetLane(square_root(lanes<lane_vector<R>>(hn::Set(d, a))).v);
}

/// The largest error of roots of numbers between 2^low and 2^high, in units in the last place.
template <class R>
R worst_error(int low, int high) {
  std::mt19937 random(2009);
  std::uniform_real_distribution<R> mantissa(1, 2);
  std::uniform_int_distribution<int> exponent(low, high);
  R worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const R a = std::ldexp(mantissa(random), exponent(random)), exact = std::sqrt(a);
    const R ulp = std::nextafter(exact, std::numeric_limits<R>::infinity()) - exact;
    worst = std::max(worst, std::abs(root(a) - exact) / ulp);
  }
  return worst;
}

TEST(root, is_within_one_unit_in_the_last_place) {
  EXPECT_LE(worst_error<double>(-900, 900), 1);
  EXPECT_LE(worst_error<float>(-110, 120), 1);
}

TEST(root, of_squares_that_make_all_the_difference) {
  for (const double a : {0.25, 1.0, 4.0, 9.0, 1e-20 * 1e-20}) EXPECT_NEAR(root(a) / std::sqrt(a), 1, 3e-16) << a;
}

TEST(root, of_nothing_is_next_to_nothing) {
  EXPECT_LE(root(0.0), 1.01e-145);
  EXPECT_GE(root(0.0), 0);
  EXPECT_LE(root(0.0f), 1.01e-18f);
  EXPECT_GE(root(0.0f), 0);
  EXPECT_LE(root(std::numeric_limits<double>::min()), 1.01e-145);
}

TEST(root, of_no_number_is_no_number) {
  EXPECT_TRUE(std::isnan(root(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(root(std::numeric_limits<float>::quiet_NaN())));
}

}  // namespace
}  // namespace pairsum
#endif

#include <gtest/gtest.h>

#include <limits>

#include "harness/verify/compare.hpp"

namespace pairsum::harness {
namespace {

expectation two_particles() {
  expectation e;
  e.names = {"drho"};
  e.ids = {0, 2};
  e.value = {{1.0, -2.0}};
  e.bound = {{0.1, 0.2}};
  e.magnitude = {{1.0, 4.0}};
  return e;
}

rate_table rates(double first, double last) { return {{"drho"}, {{first, 99.0, last}}}; }

TEST(compare, accepts_within_the_bound_and_reports_the_entry_nearest_to_it) {
  const verdict v = compare(rates(1.05, -2.19), two_particles());
  EXPECT_TRUE(v.ok);
  EXPECT_NEAR(v.max_rel_err, 0.19 / 4, 1e-12);
  EXPECT_NEAR(v.bound, 0.2 / 4, 1e-12);
}

TEST(compare, rejects_one_entry_out_of_bounds_and_names_it) {
  const verdict v = compare(rates(1.0, -2.3), two_particles());
  EXPECT_FALSE(v.ok);
  EXPECT_GT(v.max_rel_err, v.bound);
  EXPECT_NE(v.error.find("drho of particle 2"), std::string::npos) << v.error;
  EXPECT_NE(v.error.find("1 of 2"), std::string::npos) << v.error;
}

TEST(compare, rejects_nan_and_infinity) {
  EXPECT_FALSE(compare(rates(std::numeric_limits<double>::quiet_NaN(), -2), two_particles()).ok);
  EXPECT_FALSE(compare(rates(std::numeric_limits<double>::infinity(), -2), two_particles()).ok);
}

TEST(compare, rejects_an_infinite_rate_with_an_infinite_bound) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  expectation e = two_particles();
  e.bound = {{infinity, 0.2}};
  EXPECT_FALSE(compare(rates(infinity, -2), e).ok);
  EXPECT_FALSE(compare(rates(-infinity, -2), e).ok);
  EXPECT_NE(compare(rates(infinity, -2), e).error.find("drho of particle 0"), std::string::npos);
  e.bound = {{0.1, 0.2}};
  EXPECT_TRUE(compare(rates(1, -2), e).ok) << "the bound alone was wrong";
}

TEST(compare, says_where_the_reference_is_not_finite) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  expectation e = two_particles();
  e.value = {{1.0, nan}};
  const verdict v = compare(rates(1, nan), e);
  EXPECT_FALSE(v.ok);
  EXPECT_FALSE(v.finite);
  EXPECT_EQ(v.error, "drho of particle 2 is not finite in the reference, or its bound is not");
  EXPECT_TRUE(compare(rates(nan, -2), two_particles()).finite) << "the backend alone was wrong";
}

TEST(compare, integers_have_no_tolerance) {
  expectation e = two_particles();
  e.bound = {{0, 0}};
  EXPECT_TRUE(compare(rates(1, -2), e).ok);
  EXPECT_FALSE(compare(rates(1, -1), e).ok);
}

TEST(compare, rejects_other_columns) {
  rate_table r = rates(1, -2);
  r.names = {"dv_x"};
  EXPECT_FALSE(compare(r, two_particles()).ok);
}

}  // namespace
}  // namespace pairsum::harness

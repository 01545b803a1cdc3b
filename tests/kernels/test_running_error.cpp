#include <pairsum/reference/running_error.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <pairsum/core/random.hpp>

// Random expressions in float with their bounds against the same expressions in long double, whose
// own error (2^-64) is nothing beside a float's (2^-24).
namespace pairsum {
namespace {

using tracked = running_error<float>;
constexpr long double slack = 1 + 1e-9L;  // for the rounding of long double

struct value {
  tracked bounded;
  long double exact;
  long double error() const { return std::abs(static_cast<long double>(bounded.v) - exact); }
};

value leaf(const counter_random& random, std::uint64_t at) {
  const float a = static_cast<float>(random.uniform(at, -10, 10));
  return {tracked(a), a};
}

/// A random expression of up to `operations` operations on a pool of values, each at most 1e6 and
/// at least 1e-6 in size.
value expression(std::uint64_t seed, int operations) {
  const counter_random random(seed, 5);
  std::vector<value> pool;
  for (std::uint64_t k = 0; k < 4; ++k) pool.push_back(leaf(random, k));
  for (int n = 0; n < operations; ++n) {
    const auto at = 10 + 4 * static_cast<std::uint64_t>(n);
    const value& a = pool[random.bits(at) % pool.size()];
    const value& b = pool[random.bits(at + 1) % pool.size()];
    value c{};
    switch (random.bits(at + 2) % 8) {
      case 0:
        c = {a.bounded + b.bounded, a.exact + b.exact};
        break;
      case 1:
        c = {a.bounded - b.bounded, a.exact - b.exact};
        break;
      case 2:
        c = {a.bounded * b.bounded, a.exact * b.exact};
        break;
      case 3:
        if (b.bounded.size() <= 2 * b.bounded.e) continue;
        c = {a.bounded / b.bounded, a.exact / b.exact};
        break;
      case 4:
        if (a.exact < 0 || a.bounded.v < 0) continue;
        c = {square_root(a.bounded), std::sqrt(a.exact)};
        break;
      case 5:
        c = {maximum(a.bounded, b.bounded), std::max(a.exact, b.exact)};
        break;
      case 6:
        c = {absolute(-a.bounded), std::abs(-a.exact)};
        break;
      default:
        c = {power(a.bounded, 3), a.exact * a.exact * a.exact};
    }
    if (c.bounded.v != 0 && (c.bounded.size() > 1e6 || c.bounded.size() < 1e-6)) continue;
    pool.push_back(c);
  }
  return pool.back();
}

/// Of 20000 random expressions, how many are further from the truth than `scale` times their bound?
int violations(long double scale) {
  int n = 0;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    const value v = expression(seed, 3 + static_cast<int>(seed % 10));
    n += !(v.error() <= scale * slack * v.bounded.e);
  }
  return n;
}

TEST(running_error, bounds_hold_for_random_expressions) { EXPECT_EQ(violations(1), 0); }
TEST(running_error, check_rejects_bounds_that_are_too_small) { EXPECT_GT(violations(0.2L), 0); }

TEST(running_error, bounds_are_not_absurdly_loose) {
  std::vector<long double> looseness;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    const value v = expression(seed, 8);
    if (v.error() > 0) looseness.push_back(v.bounded.e / v.error());
  }
  ASSERT_GT(looseness.size(), 5000u);
  std::ranges::nth_element(looseness, looseness.begin() + static_cast<long>(looseness.size() / 2));
  EXPECT_LT(looseness[looseness.size() / 2], 1e2L) << "median of bound/error";
  EXPECT_GE(looseness[looseness.size() / 2], 1);
}

TEST(running_error, a_cancellation_keeps_its_bound) {
  const tracked third = tracked(1.0f) / tracked(3.0f);
  const tracked zero = third * tracked(3.0f) - tracked(1.0f);
  EXPECT_GE(zero.e, std::abs(static_cast<double>(zero.v)));
  EXPECT_GT(zero.e, 1e-8);
  EXPECT_LT(zero.e, 1e-6);
}

TEST(running_error, of_exact_inputs_and_exact_operations) {
  const tracked two(2.0f);
  EXPECT_EQ(two.e, 0);
  EXPECT_EQ((-two).e, 0);
  EXPECT_EQ(absolute(-two).v, 2.0f);
  EXPECT_EQ(maximum(two, tracked(1.0f)).v, 2.0f);
  EXPECT_EQ(maximum(tracked(1.0f, 0.5), tracked(3.0f, 0.25)).e, 0.5) << "either may be the larger one";
  EXPECT_EQ(square_root(tracked(0.0f)).e, 0);
  EXPECT_EQ(square_root(tracked(0.0f, 4.0)).e, 2) << "the truth may be anything in [0, 4]";
  EXPECT_EQ(select(true, two, tracked(1.0f)).v, 2.0f);
}

/// Of 20000 Gaussians exp(-9 (a/b)^2), down to those that underflow, how many are further from the truth than `scale`
/// times their bound?
int exponential_violations(long double scale) {
  const counter_random random(7, 5);
  int n = 0;
  for (std::uint64_t k = 0; k < 20000; ++k) {
    const float a = static_cast<float>(random.uniform(2 * k, 0, 4)),
                b = static_cast<float>(random.uniform(2 * k + 1, 1, 2));
    const tracked q = tracked(a) / tracked(b), y = exponential(tracked(-9) * (q * q));
    const long double ratio = static_cast<long double>(a) / b, exact = std::exp(-9 * ratio * ratio);
    n += !(std::abs(y.v - exact) <= scale * slack * y.e);
  }
  return n;
}

/// Values in double with a bound for evaluation in float: how many of some evaluations are off by more than `share` of
/// their bound?
int violations_in_coarser_unit(double share) {
  using coarse = running_error<double, float>;
  const auto f = []<class T>(const T& a, const T& b, const T& c) {
    return square_root(a * a + b * b) - T(1.1) * c / (a * b + T(30)) + maximum(a, c) * (b - c);
  };
  int violations = 0;
  for (std::uint64_t seed = 0; seed < 10000; ++seed) {
    const counter_random random(seed, 9);
    double x[3];
    for (std::uint64_t k = 0; k < 3; ++k) x[k] = random.uniform(k, -5, 5);
    const coarse bounded = f(coarse(x[0]), coarse(x[1]), coarse(x[2]));
    const double in_float = f(static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2]));
    violations += !(std::abs(in_float - bounded.v) <= share * bounded.e);
  }
  return violations;
}
TEST(running_error, bound_holds_for_a_coarser_unit) { EXPECT_EQ(violations_in_coarser_unit(1), 0); }
TEST(running_error, check_rejects_bounds_of_a_coarser_unit_that_are_too_small) {
  EXPECT_GT(violations_in_coarser_unit(0.05), 0);
}

TEST(running_error, bound_holds_for_exponentials) { EXPECT_EQ(exponential_violations(1), 0); }
TEST(running_error, check_rejects_bounds_of_exponentials_that_are_too_small) {
  EXPECT_GT(exponential_violations(0.2L), 0);
}

TEST(running_error, of_exponentials) {
  const double half_ulp = 0x1p-24;  // of 1
  const tracked one = exponential(tracked(0.0f));
  EXPECT_EQ(one.v, 1);
  EXPECT_GT(one.e, half_ulp) << "exp may err by an ulp";
  EXPECT_LT(one.e, 8 * half_ulp);
  EXPECT_NEAR(exponential(tracked(0.0f, 1.0)).e, std::exp(1.0) - 1, 8 * half_ulp) << "the truth may be e";
  const tracked nothing = exponential(tracked(-1000.0f));
  EXPECT_EQ(nothing.v, 0);
  EXPECT_GT(nothing.e, 0) << "underflow";
}

}  // namespace
}  // namespace pairsum

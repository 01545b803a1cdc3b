#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include <pairsum/vector/compiled_lanes.hpp>

// Roots lane by lane, by the instruction set this is compiled for.
#if PAIRSUM_LANES
namespace pairsum {
namespace {

template <class R>
using lanes_of = std::array<R, lane_count<R>>;

template <class R>
lanes_of<R> root(const lanes_of<R>& a) {
  const lane_tag<R> d;
  lanes_of<R> out;
  hn::StoreU(square_root(lanes<lane_vector<R>>(hn::LoadU(d, a.data()))).v, d, out.data());
  return out;
}
template <class R>
R root(R a) {
  lanes_of<R> all;
  all.fill(a);
  const auto roots = root(all);
  for (const R r : roots) EXPECT_TRUE(r == roots[0] || std::isnan(r));
  return roots[0];
}

/// The largest distance of f(a) from the rounded root, in units in the last place, over numbers from 2^low to 2^high.
template <class R, class F>
R worst_error(int low, int high, F&& f) {
  std::mt19937 random(2009);
  std::uniform_real_distribution<R> mantissa(1, 2);
  std::uniform_int_distribution<int> exponent(low, high);
  R worst = 0;
  for (int k = 0; k < 20000; ++k) {
    lanes_of<R> a;
    for (R& x : a) x = std::ldexp(mantissa(random), exponent(random));
    const lanes_of<R> roots = f(a);
    for (std::size_t l = 0; l < a.size(); ++l) {
      const R exact = std::sqrt(a[l]), ulp = std::nextafter(exact, std::numeric_limits<R>::infinity()) - exact;
      worst = std::max(worst, std::abs(roots[l] - exact) / ulp);
    }
  }
  return worst;
}

TEST(root, is_the_rounded_one_or_a_neighbour) {
  EXPECT_LE(worst_error<double>(-1020, 1022, [](const auto& a) { return root(a); }), 1);
  EXPECT_LE(worst_error<float>(-124, 126, [](const auto& a) { return root(a); }), 1);
}

/// As any table of inverse roots may have them: off by up to 2^-14, by which `off` is multiplied.
template <class R>
lanes_of<R> series(const lanes_of<R>& a, R off) {
  lanes_of<R> y, out;
  for (std::size_t l = 0; l < a.size(); ++l) y[l] = (1 + (l % 2 == 0 ? off : -off) / R(1 << 14)) / std::sqrt(a[l]);
  const lane_tag<R> d;
  hn::StoreU(root_by_series(d, hn::LoadU(d, a.data()), hn::LoadU(d, y.data())), d, out.data());
  return out;
}

TEST(root, by_series_from_the_worst_table) {
  if (HWY_NATIVE_FMA == 0) GTEST_SKIP() << "the series is for sets that round a product and a sum once";
  EXPECT_LE(worst_error<double>(-900, 900, [](const auto& a) { return series(a, 1.0); }), 1);
  EXPECT_LE(worst_error<float>(-100, 100, [](const auto& a) { return series(a, 1.0f); }), 1);
  EXPECT_GT(worst_error<double>(-900, 900, [](const auto& a) { return series(a, 4.0); }), 100) << "a worse table";
  EXPECT_GT(worst_error<float>(-100, 100, [](const auto& a) { return series(a, 64.0f); }), 1) << "a worse table";
}

template <class R>
void of_what_is_no_positive_number() {
  EXPECT_EQ(root(R(0)), 0);
  EXPECT_TRUE(std::isnan(root(R(-1))));
  EXPECT_TRUE(std::isnan(root(std::numeric_limits<R>::quiet_NaN())));
}
TEST(root, of_zero_is_zero_and_of_less_no_number) {
  of_what_is_no_positive_number<double>();
  of_what_is_no_positive_number<float>();
}

}  // namespace
}  // namespace pairsum
#endif

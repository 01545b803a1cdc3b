#include "harness/model/peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pairsum/core/column.hpp>
#include <pairsum/core/error.hpp>
#include <pairsum/core/workers.hpp>

namespace pairsum::harness {
namespace {

template <class R>
class peaks_test : public testing::Test {};
using precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(peaks_test, precisions);

TYPED_TEST(peaks_test, triad_is_computed) {
  using R = TypeParam;
  const std::size_t n = 64 * 5;
  column<R> a(n), b(n), c(n);
  for (std::size_t i = 0; i < n; ++i) a[i] = -1, b[i] = R(i), c[i] = R(2 * i + 1);
  peak_loops::triad(a.data(), b.data(), c.data(), R(3), n - 64);
  for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(a[i], i < n - 64 ? R(7 * i + 3) : R(-1)) << i;
}

TYPED_TEST(peaks_test, every_multiply_add_is_computed) {
  using R = TypeParam;
  const std::size_t n = peak_loops::multiply_add_width<R>();
  ASSERT_GE(n, 12u);
  for (const std::uint64_t steps : {0, 1, 2, 100}) {
    std::vector<R> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = R(i);
    peak_loops::multiply_add(values, R(0.96875), R(0.3), steps);
    for (std::size_t i = 0; i < n; ++i) {
      long double x = R(i);
      for (std::uint64_t k = 0; k < steps; ++k) x = x * R(0.96875) + R(0.3);
      ASSERT_NEAR(values[i], static_cast<double>(x), 100 * static_cast<double>(n) * std::numeric_limits<R>::epsilon())
          << i << " after " << steps;
    }
  }
}

TEST(peaks, are_positive_and_finite) {
  const peak_limits quick{.last_level_cache_bytes = 1 << 18, .budget_s = 0.05};
  for (const std::string precision : {"double", "float"})
    for (const int threads : {1, 2}) {
      const peak_rates p = measure_peaks(precision, team::omp(threads), quick);
      EXPECT_TRUE(std::isfinite(p.bandwidth_bytes_per_s) && std::isfinite(p.flops_per_s));
      EXPECT_GT(p.bandwidth_bytes_per_s, 0);
      EXPECT_GT(p.flops_per_s, 0);
      const double pace = measure_multiply_adds(precision, team::omp(threads), 0.05);
      EXPECT_GT(pace, p.flops_per_s / 16);  // nearer than a lost factor of lanes, if the machine is disturbed
      EXPECT_LT(pace, p.flops_per_s * 16);
    }
  EXPECT_GT(measure_peaks("double", team(), quick).flops_per_s, 0);
}

TEST(peaks, arrays_outgrow_the_caches_but_not_the_memory) {
  EXPECT_EQ(triad_array_bytes(1 << 20), std::size_t{4} << 20);
  EXPECT_EQ(triad_array_bytes(std::uint64_t{260} << 20), std::size_t{256} << 20);
  EXPECT_EQ(triad_array_bytes(0), std::size_t{256} << 20) << "unknown";
  EXPECT_EQ(triad_array_bytes(1'000'001) % 64, 0u);
}

template <class F>
std::string message(F&& f) {
  try {
    f();
  } catch (const error& e) {
    return e.what();
  }
  return {};
}

TEST(peaks, refuse_what_they_cannot_measure) {
  EXPECT_EQ(message([] { measure_peaks("half", team()); }), "unknown precision \"half\"; valid: double, float, mixed");
  EXPECT_EQ(message([] { measure_multiply_adds("half", team(), 0.1); }),
            "unknown precision \"half\"; valid: double, float, mixed");
  const workers tbb(runtime::tbb, 2);
  EXPECT_EQ(message([&] { measure_peaks("double", tbb.get()); }),
            "peaks are measured on a serial or an OpenMP team, not on oneTBB's");
}

}  // namespace
}  // namespace pairsum::harness

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include <pairsum/smoothing/cubic_spline.hpp>
#include <pairsum/smoothing/gaussian.hpp>
#include <pairsum/smoothing/wendland_c2.hpp>
#include <pairsum/smoothing/wendland_c4.hpp>
#include <pairsum/smoothing/wendland_c6.hpp>
#include "smoothing_literature.hpp"

// Every smoothing kernel in every dimension and precision against what defines it.
namespace pairsum {
namespace {

using namespace test_kit;

/// A kernel's class template as a type, with its name in the names of the tests.
template <template <int, class> class K>
struct kernel {
  template <int D, class R>
  using of = K<D, R>;
  static constexpr std::string_view name = K<1, double>::name;
};
struct kernel_names {
  template <class T>
  static std::string GetName(int) {
    return std::string(T::name);
  }
};

constexpr double radii[] = {0.01188, 0.5, 1, 50};

template <class T>
class smoothing_test : public testing::Test {
 protected:
  /// Calls f<D, R>(W, H) for 1D, 2D, 3D, double, float and a few support radii.
  template <class F>
  static void each(F&& f) {
    const auto one = [&]<int D, class R>() {
      SCOPED_TRACE(std::to_string(D) + "D, " + std::to_string(sizeof(R)) + " bytes");
      for (const double H : radii) f.template operator()<D, R>(typename T::template of<D, R>(H), H);
    };
    one.template operator()<1, double>();
    one.template operator()<2, double>();
    one.template operator()<3, double>();
    one.template operator()<1, float>();
    one.template operator()<2, float>();
    one.template operator()<3, float>();
  }
  static constexpr bool compact = T::name != "gaussian";
};
using kernels = testing::Types<kernel<wendland_c2>, kernel<wendland_c4>, kernel<wendland_c6>, kernel<cubic_spline>,
                               kernel<gaussian>>;
TYPED_TEST_SUITE(smoothing_test, kernels, kernel_names);

template <class R>
constexpr real_t epsilon = std::numeric_limits<R>::epsilon();

/// Integral of f over [a, b]: Gauss-Legendre with five points (exact for degree 9) in 20 pieces.
template <class F>
real_t integral(real_t a, real_t b, F&& f) {
  const real_t root70 = std::sqrt(70.0L), step = (b - a) / 20;
  real_t sum = 0;
  for (int piece = 0; piece < 20; ++piece) {
    const real_t middle = a + (piece + 0.5L) * step;
    sum += 128.0L / 225 * f(middle);
    for (const int sign : {-1, 1}) {
      const real_t node = std::sqrt(5 + sign * 2 * std::sqrt(10.0L / 7)) / 3, weight = (322 - sign * 13 * root70) / 900;
      sum += weight * (f(middle - node * step / 2) + f(middle + node * step / 2));
    }
  }
  return sum * step / 2;
}

template <int D>
real_t sphere(real_t r) {
  return D == 1 ? 2 : D == 2 ? 2 * pi_l * r : 4 * pi_l * r * r;
}

TYPED_TEST(smoothing_test, integral_is_1) {
  this->each([]<int D, class R>(const auto& W, double H) {
    const auto over = [&]<int S>() { return integral(0, H, [&](real_t r) { return sphere<S>(r) * W.value(R(r)); }); };
    EXPECT_NEAR(over.template operator()<D>(), 1, 32 * epsilon<R>);
    if (H == 0.5) {
      EXPECT_GT(std::abs(over.template operator()<D % 3 + 1>() - 1), 0.1) << "of another dimension is not";
    }
  });
}

/// Difference quotients of W are means of W' = F r, up to rounding.
TYPED_TEST(smoothing_test, slope_over_r_is_the_derivative_over_r) {
  this->each([]<int D, class R>(const auto& W, double H) {
    for (int k = 0; k < 20; ++k) {
      const R a = R(k * H / 20), b = R((k + 1) * H / 20);
      const real_t rise = real_t(W.value(b)) - real_t(W.value(a));
      const real_t mean = integral(a, b, [&](real_t r) { return W.slope_over_r(R(r)) * r; });
      EXPECT_NEAR(mean / W.value(R(0)), rise / W.value(R(0)), 32 * epsilon<R>) << "up to " << b / H << " H";
    }
    const R tiny = R(1e-6 * H);
    EXPECT_TRUE(std::isfinite(W.slope_over_r(R(0))));
    EXPECT_NEAR(W.slope_over_r(R(0)) / W.slope_over_r(tiny), 1, 1e-4);
  });
}

TYPED_TEST(smoothing_test, is_positive_and_falls_within_the_support) {
  this->each([]<int D, class R>(const auto& W, double H) {
    EXPECT_LT(W.slope_over_r(R(0)), 0);
    for (int k = 1; k < 100; ++k) {
      const R r = R(k * H / 100);
      EXPECT_GT(W.value(r), 0);
      EXPECT_LT(W.value(r), W.value(R((k - 1) * H / 100)));
      EXPECT_LT(W.slope_over_r(r), 0);
    }
  });
}

TYPED_TEST(smoothing_test, ends_at_H) {
  this->each([]<int D, class R>(const auto& W, double H) {
    const R w = W.value(R(H)) / W.value(R(0)), f = W.slope_over_r(R(H)) / W.slope_over_r(R(0));
    if (!TestFixture::compact) {  // cut off where r < H ends
      const R before = std::nextafter(R(H), R(0));
      EXPECT_NEAR(W.value(before) / W.value(R(0)) / std::exp(-9.0L), 1, 64 * epsilon<R>);
      EXPECT_GT(W.value(R(H)), 0);
    } else if (H == 0.5 || H == 1) {  // their inverses are exact
      EXPECT_EQ(w, 0);
      EXPECT_EQ(f, 0);
    } else {
      EXPECT_LE(std::abs(w), 64 * epsilon<R> * epsilon<R>);
      EXPECT_LE(std::abs(f), 64 * epsilon<R> * epsilon<R>);
    }
  });
}

/// The largest difference from the literature, in units of what rounding explains: a few epsilons, more of them near
/// r = H, where 1 - r/H cancels.
template <int D, class R>
real_t difference(const auto& W, std::string_view name, double H) {
  real_t largest = 0;
  for (int k = 1; k < 400; ++k) {
    const R r = R(k * H / 400);
    const auto [w, f] = literature(name, D, r, H);
    const real_t unit = epsilon<R> * (32 + 8 / (1 - real_t(r) / H));
    for (const real_t error : {std::abs(W.value(r) / w - 1), std::abs(W.slope_over_r(r) / f - 1)})
      largest = std::isnan(error) ? INFINITY : std::max(largest, error / unit);
  }
  return largest;
}

TYPED_TEST(smoothing_test, is_the_formula_of_the_literature) {
  this->each([]<int D, class R>(const auto& W, double H) { EXPECT_LE((difference<D, R>(W, TypeParam::name, H)), 1); });
}

TYPED_TEST(smoothing_test, another_formula_is_rejected) {
  this->each([]<int D, class R>(const auto& W, double H) {
    EXPECT_GT((difference<D, R>(typename TypeParam::template of<D, R>(H * 1.0001), TypeParam::name, H)), 1);
    EXPECT_GT((difference<D % 3 + 1, R>(W, TypeParam::name, H)), 1) << "of another dimension";
    for (const char* other : {"wendland_c2", "wendland_c4", "wendland_c6", "cubic_spline", "gaussian"}) {
      if (other == TypeParam::name) continue;
      EXPECT_GT((difference<D, R>(W, other, H)), 1) << other;
    }
  });
}

}  // namespace
}  // namespace pairsum

#pragma once
#include <numbers>
#include <string_view>

#include <pairsum/core/value.hpp>

namespace pairsum {

/// The cubic B-spline M4 (Monaghan & Lattanzio, Astron. Astrophys. 149 (1985) 135) with smoothing length h = H/2. With
/// s = r/h in [0,2) and sigma = 2/(3h), 10/(7 pi h^2), 1/(pi h^3) in 1D, 2D, 3D:
///   W = sigma (1 - 3/2 s^2 + 3/4 s^3)  for s < 1,     W = sigma (2-s)^3/4  beyond
template <int D, class R>
class cubic_spline {
  static_assert(D >= 1 && D <= 3);

 public:
  static constexpr std::string_view name = "cubic_spline";
  static constexpr int slope_flops = 11;  ///< of slope_over_r

  /// H: support radius in m, positive.
  explicit cubic_spline(double H) : inv_h_(R(2 / H)) {
    constexpr double pi = std::numbers::pi;
    const double h = H / 2;
    const double sigma = D == 1 ? 2 / (3 * h) : D == 2 ? 10 / (7 * pi * h * h) : 1 / (pi * h * h * h);
    sigma_ = R(sigma);
    slope_ = R(sigma / (h * h));
  }

  /// W(r) in m^-D for r < H.
  template <class T>
  T value(const T& r) const {
    const T s = r * T(inv_h_), far = T(2) - s;
    const T inner = T(1) + s * s * (T(R(0.75)) * s - T(R(1.5)));
    const T outer = T(R(0.25)) * (far * far * far);
    return T(sigma_) * select(s < T(1), inner, outer);
  }

  /// F(r) = W'(r)/r in m^-(D+2) for r < H; finite at r = 0.
  template <class T>
  T slope_over_r(const T& r) const {
    const T s = r * T(inv_h_), far = T(2) - s;
    const T inner = T(R(2.25)) * s - T(3);
    const T outer = T(R(-0.75)) * (far * far) / maximum(s, T(1));
    return T(slope_) * select(s < T(1), inner, outer);
  }

 private:
  R inv_h_, sigma_, slope_;
};

}  // namespace pairsum

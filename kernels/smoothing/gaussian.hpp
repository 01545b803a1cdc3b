#pragma once
#include <cmath>
#include <numbers>
#include <string_view>

#include <pairsum/core/value.hpp>

namespace pairsum {

/// A Gaussian of smoothing length h = H/3, cut off at H and normalised to integral 1 over its support. With q = r/H in
/// [0,1):  W = alpha exp(-9 q^2),  1/alpha = sqrt(pi)/3 erf(3) H in 1D, pi/9 (1 - e^-9) H^2 in 2D,
/// pi (sqrt(pi)/27 erf(3) - 2/9 e^-9) H^3 in 3D
template <int D, class R>
class gaussian {
  static_assert(D >= 1 && D <= 3);

 public:
  static constexpr std::string_view name = "gaussian";
  static constexpr int slope_flops = 5;  ///< of slope_over_r

  /// H: support radius in m, positive.
  explicit gaussian(double H) : inv_H_(R(1 / H)) {
    constexpr double pi = std::numbers::pi;
    const double root = std::sqrt(pi), tail = std::exp(-9.0);
    const double integral = D == 1   ? root / 3 * std::erf(3.0) * H
                            : D == 2 ? pi / 9 * (1 - tail) * H * H
                                     : pi * (root * std::erf(3.0) / 27 - 2 * tail / 9) * H * H * H;
    alpha_ = R(1 / integral);
    slope_ = R(-18 / (integral * H * H));
  }

  /// W(r) in m^-D for r < H.
  template <class T>
  T value(const T& r) const {
    const T q = r * T(inv_H_);
    return T(alpha_) * exponential(T(-9) * (q * q));
  }

  /// F(r) = W'(r)/r in m^-(D+2) for r < H; finite at r = 0.
  template <class T>
  T slope_over_r(const T& r) const {
    const T q = r * T(inv_H_);
    return T(slope_) * exponential(T(-9) * (q * q));
  }

 private:
  R inv_H_, alpha_, slope_;
};

}  // namespace pairsum

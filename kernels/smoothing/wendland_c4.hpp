#pragma once
#include <numbers>
#include <string_view>

#include <pairsum/core/value.hpp>

namespace pairsum {

/// Wendland's C4 function with support radius H (H. Wendland, Adv. Comput. Math. 4 (1995) 389; normalised as in Dehnen
/// & Aly, MNRAS 425 (2012) 1068, table 1). With q = r/H in [0,1):
///   1D: W = 3/(2 H) (1-q)^5 (1 + 5q + 8q^2)
///   2D: 9/(pi H^2) (1-q)^6 (1 + 6q + 35/3 q^2),   3D: 495/(32 pi H^3) times the same
template <int D, class R>
class wendland_c4 {
  static_assert(D >= 1 && D <= 3);

 public:
  static constexpr std::string_view name = "wendland_c4";
  static constexpr int slope_flops = D == 1 ? 8 : 9;  ///< of slope_over_r

  /// H: support radius in m, positive.
  explicit wendland_c4(double H) : inv_H_(R(1 / H)) {
    constexpr double pi = std::numbers::pi;
    const double alpha = D == 1 ? 3 / (2 * H) : D == 2 ? 9 / (pi * H * H) : 495 / (32 * pi * H * H * H);
    alpha_ = R(alpha);
    slope_ = R((D == 1 ? -14.0 : -56.0 / 3) * alpha / (H * H));
  }

  /// W(r) in m^-D for r < H.
  template <class T>
  T value(const T& r) const {
    const T q = r * T(inv_H_), s = T(1) - q, s2 = s * s;
    if constexpr (D == 1) return T(alpha_) * (s2 * s2 * s) * (T(1) + q * (T(5) + T(8) * q));
    return T(alpha_) * (s2 * s2 * s2) * (T(1) + q * (T(6) + T(R(35.0 / 3)) * q));
  }

  /// F(r) = W'(r)/r in m^-(D+2) for r < H; finite at r = 0.
  template <class T>
  T slope_over_r(const T& r) const {
    const T q = r * T(inv_H_), s = T(1) - q, s2 = s * s;
    if constexpr (D == 1) return T(slope_) * (s2 * s2) * (T(1) + T(4) * q);
    return T(slope_) * (s2 * s2 * s) * (T(1) + T(5) * q);
  }

 private:
  R inv_H_, alpha_, slope_;
};

}  // namespace pairsum

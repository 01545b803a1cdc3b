#pragma once
#include <numbers>
#include <string_view>

#include <pairsum/core/value.hpp>

namespace pairsum {

/// Wendland's C6 function with support radius H (H. Wendland, Adv. Comput. Math. 4 (1995) 389; normalised as in Dehnen
/// & Aly, MNRAS 425 (2012) 1068, table 1). With q = r/H in [0,1):
///   1D: W = 55/(32 H) (1-q)^7 (1 + 7q + 19q^2 + 21q^3)
///   2D: 78/(7 pi H^2) (1-q)^8 (1 + 8q + 25q^2 + 32q^3),   3D: 1365/(64 pi H^3) times the same
template <int D, class R>
class wendland_c6 {
  static_assert(D >= 1 && D <= 3);

 public:
  static constexpr std::string_view name = "wendland_c6";
  static constexpr int slope_flops = D == 1 ? 11 : 12;  ///< of slope_over_r

  /// H: support radius in m, positive.
  explicit wendland_c6(double H) : inv_H_(R(1 / H)) {
    constexpr double pi = std::numbers::pi;
    const double alpha = D == 1 ? 55 / (32 * H) : D == 2 ? 78 / (7 * pi * H * H) : 1365 / (64 * pi * H * H * H);
    alpha_ = R(alpha);
    slope_ = R((D == 1 ? -6 : -22) * alpha / (H * H));
  }

  /// W(r) in m^-D for r < H.
  template <class T>
  T value(const T& r) const {
    const T q = r * T(inv_H_), s = T(1) - q, s2 = s * s, s4 = s2 * s2;
    if constexpr (D == 1) return T(alpha_) * (s4 * s2 * s) * (T(1) + q * (T(7) + q * (T(19) + T(21) * q)));
    return T(alpha_) * (s4 * s4) * (T(1) + q * (T(8) + q * (T(25) + T(32) * q)));
  }

  /// F(r) = W'(r)/r in m^-(D+2) for r < H; finite at r = 0.
  template <class T>
  T slope_over_r(const T& r) const {
    const T q = r * T(inv_H_), s = T(1) - q, s2 = s * s, s4 = s2 * s2;
    if constexpr (D == 1) return T(slope_) * (s4 * s2) * (T(3) + q * (T(18) + T(35) * q));
    return T(slope_) * (s4 * s2 * s) * (T(1) + q * (T(7) + T(16) * q));
  }

 private:
  R inv_H_, alpha_, slope_;
};

}  // namespace pairsum

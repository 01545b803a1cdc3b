#pragma once
#include <numbers>
#include <string_view>

#include <pairsum/core/value.hpp>

namespace pairsum {

/// Wendland's C2 function with support radius H (the talk's "quintic" in 2D and 3D; H. Wendland, Adv. Comput. Math. 4
/// (1995) 389, normalised as in Dehnen & Aly, MNRAS 425 (2012) 1068, table 1). With q = r/H in [0,1):
///   1D: W = 5/(4 H) (1-q)^3 (3q+1),   2D: 7/(pi H^2) (1-q)^4 (4q+1),   3D: 21/(2 pi H^3) (1-q)^4 (4q+1)
template <int D, class R>
class wendland_c2 {
  static_assert(D >= 1 && D <= 3);

 public:
  static constexpr std::string_view name = "wendland_c2";
  static constexpr int slope_flops = D == 1 ? 4 : 5;  ///< of slope_over_r

  /// H: support radius in m, positive.
  explicit wendland_c2(double H) : inv_H_(R(1 / H)) {
    constexpr double pi = std::numbers::pi;
    const double alpha = D == 1 ? 5 / (4 * H) : D == 2 ? 7 / (pi * H * H) : 21 / (2 * pi * H * H * H);
    alpha_ = R(alpha);
    slope_ = R((D == 1 ? -12 : -20) * alpha / (H * H));
  }

  /// W(r) in m^-D for r < H.
  template <class T>
  T value(const T& r) const {
    const T q = r * T(inv_H_), s = T(1) - q;
    if constexpr (D == 1) return T(alpha_) * (s * s * s) * (T(3) * q + T(1));
    const T s2 = s * s;
    return T(alpha_) * (s2 * s2) * (T(4) * q + T(1));
  }

  /// F(r) = W'(r)/r in m^-(D+2) for r < H; finite at r = 0, and grad W = F(r) r.
  template <class T>
  T slope_over_r(const T& r) const {
    const T s = T(1) - r * T(inv_H_);
    if constexpr (D == 1) return T(slope_) * (s * s);
    return (T(slope_) * s) * (s * s);
  }

 private:
  R inv_H_, alpha_, slope_;
};

}  // namespace pairsum

#pragma once
#include <algorithm>
#include <cmath>

#include <pairsum/interactions/ferrari09.hpp>

namespace pairsum::harness {

/// ferrari09 with walls that hold. Its mirrored ghosts cannot: the force of a boundary particle's ghost is F(2 d) d,
/// which goes to 0 with the distance d, and the pressure of the fluid behind pushes a particle through. So boundary
/// particles also repel, as those of Monaghan & Kajtar (Comput. Phys. Commun. 180 (2009) 1811), singular at d = 0:
///
///   dv_i/dt += K (1 - r2/R2)^2 r/r2    for r = x_i - x_b, |r| < R = min(H/2, dx),    K = 0.2 c0^2
///
/// c0: the sound speed at rest. K is a squared speed as in g depth, so walls hold at every spacing. Fluid that begins a
/// spacing away from its walls is not pushed.
template <int D, class R, template <int, class> class Smoothing>
class ferrari09_hard : public ferrari09<D, R, Smoothing> {
  using base = ferrari09<D, R, Smoothing>;

 public:
  static constexpr std::string_view name = "ferrari09_hard";
  static constexpr bool boundary_is_singular = true;
  static constexpr double wall_strength = 0.2;
  static constexpr pair_flops flops{base::flops.both, base::flops.one_sided, base::flops.boundary + 2 * D + 6};

  explicit ferrari09_hard(const physics& p)
      : base(p),
        strength_(R(wall_strength * p.eos.sound_speed0() * p.eos.sound_speed0())),
        inv_reach2_(R(1 / std::pow(p.dx > 0 ? std::min(p.H / 2, p.dx) : p.H / 2, 2))) {}

  template <class T>
  typename base::template rates<T> boundary(const vec<D, T>& r, const T& r2,
                                            const typename base::template particle<T>& i,
                                            const typename base::template boundary_particle<T>& b) const {
    auto rates = base::boundary(r, r2, i, b);
    const T left = maximum(T(1) - r2 * T(inv_reach2_), T(0));
    rates.dv += (T(strength_) * (left * left) / r2) * r;
    return rates;
  }

 private:
  R strength_, inv_reach2_;
};

}  // namespace pairsum::harness

#pragma once
#include <pairsum/interactions/interaction.hpp>

namespace pairsum {

/// Weakly compressible SPH with artificial viscosity and Lennard-Jones walls (Monaghan, J. Comput. Phys. 110 (1994)
/// 399). With r = x_i - x_j, v_ij = v_i - v_j, F = W'(r)/r, h = H/2, c = (c_i + c_j)/2, rho = (rho_i + rho_j)/2:
///
///   drho_i/dt += m_j F v_ij.r                                     drho_j/dt += m_i F v_ij.r
///   a = (p_i/rho_i^2 + p_j/rho_j^2 + Pi) F r                      dv_i/dt -= m_j a,   dv_j/dt += m_i a
///   Pi = (-alpha c mu + beta mu^2)/rho for v_ij.r < 0, else 0;    mu = h v_ij.r/(r^2 + 0.01 h^2)
///
/// A boundary particle repels a fluid particle closer than r0 = H/4 with the acceleration D ((r0/r)^4 - (r0/r)^2)
/// r/r^2, D = 100 m2/s2; there is none at r = 0, so a fluid particle exactly on a boundary particle is refused. (Closer
/// than about 1e-6 H it exceeds what float holds, and the rates are not finite.)
template <int D, class R, template <int, class> class Smoothing>
class monaghan94 {
 public:
  static constexpr std::string_view name = "monaghan94";
  static constexpr int dim = D;
  using real = R;
  using smoothing = Smoothing<D, R>;
  static constexpr double boundary_reach = 0.25;
  static constexpr bool boundary_is_singular = true;
  static constexpr pair_flops flops{.both = 19 + 7 * D + smoothing::slope_flops,
                                    .one_sided = 16 + 5 * D + smoothing::slope_flops,
                                    .boundary = 5 + 2 * D};
  static constexpr double alpha = 0.01, beta = 0, wall_strength = 100;

  template <class T>
  struct particle {
    vec<D, T> v;
    T m, rho, p_rho2, c;  ///< p_rho2 = p/rho^2, c: sound speed
    static constexpr auto fields() {
      return std::make_tuple(&particle::v, &particle::m, &particle::rho, &particle::p_rho2, &particle::c);
    }
  };
  template <class T>
  using boundary_particle = nothing;  // only its position matters
  template <class T>
  struct rates {
    T drho;        ///< kg/(m3 s)
    vec<D, T> dv;  ///< m/s2
    static constexpr auto fields() { return std::make_tuple(&rates::drho, &rates::dv); }
    static constexpr std::array<std::string_view, 2> names{"drho", "dv"};
  };

  explicit monaghan94(const physics& p)
      : W_(p.H), eos_(p.eos), h_(R(p.H / 2)), soft_(R(0.0025 * p.H * p.H)), r0_2_(R(p.H * p.H / 16)) {}

  template <class T>
  particle<T> derive(const particle_state<D, T>& s) const {
    return {s.v, s.m, s.rho, eos_.pressure(s.rho) / (s.rho * s.rho), eos_.sound_speed(s.rho)};
  }
  template <class T>
  nothing derive_boundary(const particle_state<D, T>&) const {
    return {};
  }

  template <class T>
  contributions<rates<T>> pair(const vec<D, T>& r, const T& r2, const particle<T>& i, const particle<T>& j) const {
    return pair_at(square_root(r2), r, r2, i, j);
  }
  template <class T>
  contributions<rates<T>> pair_at(const T& distance, const vec<D, T>& r, const T& r2, const particle<T>& i,
                                  const particle<T>& j) const {
    const T F = W_.slope_over_r(distance);
    const vec<D, T> v = i.v - j.v;
    const T v_r = v.dot(r);
    // With the speed of approach max(-v.r, 0) in place of a branch, Pi vanishes for particles that part.
    const T approach = T(h_) * maximum(-v_r, T(0)) / (r2 + T(soft_));
    const T c2 = i.c + j.c, rho2 = i.rho + j.rho;  // twice the means
    T Pi = T(R(alpha)) * c2 * approach / rho2;
    if constexpr (beta != 0) Pi += T(R(2 * beta)) * (approach * approach) / rho2;
    const T divergence = F * v_r, a = (i.p_rho2 + j.p_rho2 + Pi) * F;
    const T a_i = j.m * a, a_j = i.m * a;
    return {{j.m * divergence, -(a_i * r)}, {i.m * divergence, a_j * r}};
  }

  template <class T>
  rates<T> boundary(const vec<D, T>& r, const T& r2, const particle<T>&, const nothing&) const {
    const T s = T(r0_2_) / r2;
    const T a = T(R(wall_strength)) * (s * s - s) / r2;
    return {T(0), a * r};
  }

 private:
  smoothing W_;
  tait eos_;
  R h_, soft_, r0_2_;
};

}  // namespace pairsum

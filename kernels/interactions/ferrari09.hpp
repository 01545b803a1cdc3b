#pragma once
#include <pairsum/interactions/interaction.hpp>

namespace pairsum {

/// "Almost symmetric" weakly compressible SPH with a Rusanov flux on the density (Ferrari, Dumbser, Toro, Armanini,
/// Computers & Fluids 38 (2009) 1203). With r = x_i - x_j, v_ij = v_i - v_j, F = W'(r)/r, c_ij = max(c_i, c_j):
///
///   drho_i/dt += m_j [ F v_ij.r - c_ij F |r| (rho_j - rho_i)/rho_j ]
///   drho_j/dt += m_i [ F v_ij.r - c_ij F |r| (rho_i - rho_j)/rho_i ]
///   a = (p_i/rho_i^2 + p_j/rho_j^2) F r,      dv_i/dt -= m_j a,   dv_j/dt += m_i a
///
/// Boundary by local point symmetry: boundary particle b mirrors fluid particle i into a ghost at 2 x_b - x_i with
/// velocity 2 v_b - v_i and i's own density, pressure and mass. The ghost is 2 (x_i - x_b) away, so b acts for |x_i -
/// x_b| < H/2.
template <int D, class R, template <int, class> class Smoothing>
class ferrari09 {
 public:
  static constexpr std::string_view name = "ferrari09";
  static constexpr int dim = D;
  using real = R;
  using smoothing = Smoothing<D, R>;
  static constexpr double boundary_reach = 0.5;
  static constexpr pair_flops flops{.both = 15 + 8 * D + smoothing::slope_flops,
                                    .one_sided = 10 + 6 * D + smoothing::slope_flops,
                                    .boundary = 8 + 5 * D + smoothing::slope_flops};

  template <class T>
  struct particle {
    vec<D, T> v;
    T m, rho, inv_rho, p_rho2, c;  ///< p_rho2 = p/rho^2, c: sound speed
    static constexpr auto fields() {
      return std::make_tuple(&particle::v, &particle::m, &particle::rho, &particle::inv_rho, &particle::p_rho2,
                             &particle::c);
    }
  };
  template <class T>
  struct boundary_particle {
    vec<D, T> v;
    static constexpr auto fields() { return std::make_tuple(&boundary_particle::v); }
  };
  template <class T>
  struct rates {
    T drho;        ///< kg/(m3 s)
    vec<D, T> dv;  ///< m/s2
    static constexpr auto fields() { return std::make_tuple(&rates::drho, &rates::dv); }
    static constexpr std::array<std::string_view, 2> names{"drho", "dv"};
  };

  explicit ferrari09(const physics& p) : W_(p.H), eos_(p.eos) {}

  template <class T>
  particle<T> derive(const particle_state<D, T>& s) const {
    const T inv_rho = T(1) / s.rho;
    return {s.v, s.m, s.rho, inv_rho, eos_.pressure(s.rho) * (inv_rho * inv_rho), eos_.sound_speed(s.rho)};
  }
  template <class T>
  boundary_particle<T> derive_boundary(const particle_state<D, T>& s) const {
    return {s.v};
  }

  template <class T>
  contributions<rates<T>> pair(const vec<D, T>& r, const T& r2, const particle<T>& i, const particle<T>& j) const {
    return pair_at(square_root(r2), r, r2, i, j);
  }
  template <class T>
  contributions<rates<T>> pair_at(const T& distance, const vec<D, T>& r, const T&, const particle<T>& i,
                                  const particle<T>& j) const {
    // What does not need F comes first: F waits for a square root, and little remains to be done after it.
    const vec<D, T> v = i.v - j.v, p_r = (i.p_rho2 + j.p_rho2) * r;
    const T divergence = v.dot(r), flux = maximum(i.c, j.c) * (j.rho - i.rho) * distance;
    const T F = W_.slope_over_r(distance), F_i = j.m * F, F_j = i.m * F;
    return {{F_i * (divergence - flux * j.inv_rho), -F_i * p_r}, {F_j * (divergence + flux * i.inv_rho), F_j * p_r}};
  }

  template <class T>
  rates<T> boundary(const vec<D, T>& r, const T& r2, const particle<T>& i, const boundary_particle<T>& b) const {
    const T F = W_.slope_over_r(T(2) * square_root(r2));
    const vec<D, T> v = i.v - b.v;
    // ghost: r -> 2r, v_ij -> 2v, rho_j = rho_i, so the flux vanishes
    const T a = i.m * (T(4) * i.p_rho2) * F;
    return {i.m * (T(4) * F * v.dot(r)), -(a * r)};
  }

 private:
  smoothing W_;
  tait eos_;
};

}  // namespace pairsum

#pragma once
#include <array>

#include <pairsum/interactions/interaction.hpp>

namespace pairsum::test_kit {

/// Damped springs between all particles within H, stiffer where it is denser; densities follow the motion and even out:
///   a = -(4 (1 + kappa (rho_i + rho_j - 2)) r + v_ij/2)            dv_i/dt += m_j a,   dv_j/dt -= m_i a
///   drho_i/dt += m_j (kappa v_ij.r + rho_j - rho_i)                drho_j/dt += m_i (kappa v_ij.r + rho_i - rho_j)
/// kappa is the B of the equation of state; with kappa = 0 the problem is linear. It jumps at r = H, which no pair may
/// cross.
template <int D, class R>
class oscillators {
 public:
  static constexpr std::string_view name = "oscillators";
  static constexpr int dim = D;
  using real = R;

  template <class T>
  struct particle {
    vec<D, T> v;
    T m, rho;
    static constexpr auto fields() { return std::make_tuple(&particle::v, &particle::m, &particle::rho); }
  };
  template <class T>
  struct rates {
    T drho;
    vec<D, T> dv;
    static constexpr auto fields() { return std::make_tuple(&rates::drho, &rates::dv); }
    static constexpr std::array<std::string_view, 2> names{"drho", "dv"};
  };

  explicit oscillators(const physics& p) : kappa_(R(p.eos.B)) {}

  template <class T>
  particle<T> derive(const particle_state<D, T>& s) const {
    return {s.v, s.m, s.rho};
  }
  template <class T>
  contributions<rates<T>> pair(const vec<D, T>& r, const T&, const particle<T>& i, const particle<T>& j) const {
    const vec<D, T> v = i.v - j.v;
    const T stiffness = T(4) * (T(1) + T(kappa_) * (i.rho + j.rho - T(2))), squeeze = T(kappa_) * v.dot(r);
    const vec<D, T> a = -(stiffness * r + T(R(0.5)) * v);
    const vec<D, T> a_i = j.m * a, a_j = -(i.m * a);
    return {{j.m * (squeeze + (j.rho - i.rho)), a_i}, {i.m * (squeeze + (i.rho - j.rho)), a_j}};
  }

 private:
  R kappa_;
};

}  // namespace pairsum::test_kit

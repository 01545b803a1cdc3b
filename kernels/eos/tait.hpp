#pragma once
#include <cmath>

#include <pairsum/core/value.hpp>

namespace pairsum {

/// Tait's equation of state (Monaghan 1994, eq. 2.5): p = B((rho/rho0)^gamma - 1), c = sqrt(gamma B/rho0
/// (rho/rho0)^(gamma-1)). rho in kg/m3, p and B in Pa, c in m/s. gamma is odd, so that c needs no root per particle.
struct tait {
  static constexpr int gamma = 7;
  double rho0 = 1000;
  double B = 1e4;

  double sound_speed0() const { return std::sqrt(gamma * B / rho0); }

  template <class T>
  T pressure(const T& rho) const {
    return T(B) * (power(rho * T(1 / rho0), gamma) - T(1));
  }
  template <class T>
  T sound_speed(const T& rho) const {
    return T(sound_speed0()) * power(rho * T(1 / rho0), (gamma - 1) / 2);
  }
  /// Hydrostatic density at `depth` m below the surface under gravity g (m/s2).
  double density_at(double depth, double g) const { return rho0 * std::pow(rho0 * g * depth / B + 1, 1.0 / gamma); }
};

}  // namespace pairsum

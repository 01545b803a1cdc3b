#pragma once
#include <array>

#include <pairsum/eos/tait.hpp>
#include <pairsum/particles/particle_table.hpp>

namespace pairsum::harness {

/// Sums over the fluid, SI units. What is not 3D has 0 for the axes it lacks.
struct balance {
  double kinetic = 0, potential = 0;    ///< J; potential: m g y (m g x in 1D)
  double internal = 0;                  ///< J; what compression from rho0 has taken: see internal_energy()
  std::array<double, 3> momentum{};     ///< kg m/s
  std::array<double, 3> low{}, high{};  ///< m, of the fluid's positions
  double speed = 0;                     ///< m/s, the largest
  double rho_low = 0, rho_high = 0;     ///< kg/m3
  double energy() const { return kinetic + potential + internal; }
};

/// @param gravity m/s2
balance balance_of(const particle_table& p, double gravity, const tait& eos);

/// The integral of p/rho^2 from rho0 to rho for Tait's equation, J/kg.
double internal_energy(const tait& eos, double rho);

}  // namespace pairsum::harness

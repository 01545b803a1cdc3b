#pragma once
#include <cmath>

#include "cases/case.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/names.hpp"

namespace pairsum {

/// Fluid at rest on a cubic lattice that fills the unit cube: round(1/dx)^dim particles at the centres of cells of
/// width 1/round(1/dx); no boundary. The perturbed state is the jittered lattice that SPH codes are usually timed on.
struct lattice {
  static constexpr std::string_view name = "lattice";
  static constexpr std::string_view description =
      "fluid on a cubic lattice in the unit cube, no boundary; 1D, 2D and 3D";

  static initial_condition make(const case_parameters& c) {
    if (c.dim < 1 || c.dim > 3) throw error("lattice exists in 1D, 2D and 3D, not in " + std::to_string(c.dim) + "D");
    if (!(c.dx <= 1)) throw error("lattice needs dx <= 1 m, is " + number_text(c.dx));
    const double per_axis = std::round(1 / c.dx);
    if (std::pow(per_axis, c.dim) > 4e9)
      throw error("lattice with dx = " + number_text(c.dx) + " has more than 2^32 particles");
    check_memory(std::pow(per_axis, c.dim) * bytes_per_particle, "lattice with dx = " + number_text(c.dx),
                 "a larger dx takes less");
    const auto n = static_cast<std::size_t>(per_axis);
    initial_condition made;
    made.omega_low.assign(c.dim, 0.0);
    made.omega_high.assign(c.dim, 1.0);
    made.gravity = 0;
    particle_table& p = made.particles = particle_table(c.dim);
    std::size_t total = 1;
    for (int d = 0; d < c.dim; ++d) total *= n;
    p.resize(total);
    const double m = made.eos.rho0 / static_cast<double>(total);
    for (std::size_t i = 0; i < total; ++i) {
      std::size_t rest = i;
      for (int d = 0; d < c.dim; ++d, rest /= n) p.x[d][i] = (static_cast<double>(rest % n) + 0.5) / per_axis;
      p.rho[i] = made.eos.rho0;
      p.m[i] = m;
      p.kind[i] = particle_kind::fluid;
    }
    return made;
  }
};

}  // namespace pairsum

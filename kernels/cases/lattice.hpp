#pragma once
#include <cmath>

#include "cases/unit_cube.hpp"

namespace pairsum {

/// Fluid at rest on a cubic lattice in the unit cube, no boundary: round(1/dx)^dim particles at the centres of cells of
/// width 1/round(1/dx), ids x fastest.
inline initial_condition unit_lattice(std::string_view name, const case_parameters& c) {
  const double per_axis = std::round(1 / c.dx);
  initial_condition made = unit_cube(name, c, std::pow(per_axis, c.dim));
  particle_table& p = made.particles;
  const auto n = static_cast<std::size_t>(per_axis);
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::size_t rest = i;
    for (int d = 0; d < c.dim; ++d, rest /= n) p.x[d][i] = (static_cast<double>(rest % n) + 0.5) / per_axis;
  }
  return made;
}

/// Fluid at rest on a cubic lattice that fills the unit cube: round(1/dx)^dim particles at the centres of cells of
/// width 1/round(1/dx); no boundary. The perturbed state is the jittered lattice that SPH codes are usually timed on.
struct lattice {
  static constexpr std::string_view name = "lattice";
  static constexpr std::string_view description =
      "fluid on a cubic lattice in the unit cube, no boundary; 1D, 2D and 3D";

  static initial_condition make(const case_parameters& c) { return unit_lattice(name, c); }
};

}  // namespace pairsum

#pragma once
#include <array>
#include <cmath>
#include <string>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/error.hpp>
#include <pairsum/core/memory.hpp>
#include <pairsum/core/names.hpp>

namespace pairsum {

/// `count` fluid particles at rest that share the mass of the unit cube, no boundary, no gravity; their places are left
/// to the caller. Errors: a dimension other than 1 to 3, dx above 1 m, more particles than ids or memory hold.
inline initial_condition unit_cube(std::string_view name, const case_parameters& c, double count) {
  if (c.dim < 1 || c.dim > 3)
    throw error(std::string(name) + " exists in 1D, 2D and 3D, not in " + std::to_string(c.dim) + "D");
  if (!(c.dx <= 1)) throw error(std::string(name) + " needs dx <= 1 m, is " + number_text(c.dx));
  const std::string with_dx = std::string(name) + " with dx = " + number_text(c.dx);
  if (count > 4e9) throw error(with_dx + " has more than 2^32 particles");
  check_memory(count * bytes_per_particle, with_dx, "a larger dx takes less");
  initial_condition made;
  made.omega_low.assign(c.dim, 0.0);
  made.omega_high.assign(c.dim, 1.0);
  made.gravity = 0;
  particle_table& p = made.particles = particle_table(c.dim);
  const auto n = static_cast<std::size_t>(count);
  p.resize(n);
  p.rho.assign(n, made.eos.rho0);
  p.m.assign(n, made.eos.rho0 / count);
  p.kind.assign(n, particle_kind::fluid);
  return made;
}

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

}  // namespace pairsum

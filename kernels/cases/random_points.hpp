#pragma once
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cases/case.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/names.hpp"
#include "core/random.hpp"

namespace pairsum {

/// Fluid at rest in the unit cube, round(1/dx^dim) particles, no boundary. place(i, n) says where particle i of n lies,
/// from 0 to 1 between the planes dx/2 inside the faces (so that the perturbed state stays in Omega); ids then follow
/// the cells of width dx, x fastest, as on a lattice.
template <class Place>
initial_condition random_points(std::string_view name, const case_parameters& c, Place&& place) {
  if (c.dim < 1 || c.dim > 3)
    throw error(std::string(name) + " exists in 1D, 2D and 3D, not in " + std::to_string(c.dim) + "D");
  const std::string with_dx = std::string(name) + " with dx = " + number_text(c.dx);
  if (!(c.dx <= 1)) throw error(std::string(name) + " needs dx <= 1 m, is " + number_text(c.dx));
  const double count = std::round(std::pow(c.dx, -c.dim));
  if (count > 4e9) throw error(with_dx + " has more than 2^32 particles");
  check_memory(count * bytes_per_particle, with_dx, "a larger dx takes less");
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::array<double, 3>> points(n);
  for (std::size_t i = 0; i < n; ++i) points[i] = place(i, n);
  const auto cell = [&](const std::array<double, 3>& x) {
    std::array<std::int64_t, 3> at{};
    for (int d = 0; d < c.dim; ++d) at[2 - d] = static_cast<std::int64_t>(x[d] / c.dx);
    return at;
  };
  std::ranges::stable_sort(points, {}, cell);

  initial_condition made;
  made.omega_low.assign(c.dim, 0.0);
  made.omega_high.assign(c.dim, 1.0);
  made.gravity = 0;
  particle_table& p = made.particles = particle_table(c.dim);
  p.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < c.dim; ++d) p.x[d][i] = c.dx / 2 + (1 - c.dx) * points[i][d];
  p.rho.assign(n, made.eos.rho0);
  p.m.assign(n, made.eos.rho0 / count);
  p.kind.assign(n, particle_kind::fluid);
  return made;
}

}  // namespace pairsum

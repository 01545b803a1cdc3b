#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include <pairsum/cases/unit_cube.hpp>
#include <pairsum/core/random.hpp>

namespace pairsum {

/// Fluid at rest in the unit cube, round(1/dx^dim) particles, no boundary. place(i, n) says where particle i of n lies,
/// from 0 to 1 between the planes dx/2 inside the faces (so that the perturbed state stays in Omega); ids then follow
/// the cells of width dx, x fastest, as on a lattice.
template <class Place>
initial_condition random_points(std::string_view name, const case_parameters& c, Place&& place) {
  initial_condition made = unit_cube(name, c, std::round(std::pow(c.dx, -c.dim)));
  particle_table& p = made.particles;
  const std::size_t n = p.size();
  std::vector<std::array<double, 3>> points(n);
  for (std::size_t i = 0; i < n; ++i) points[i] = place(i, n);
  const auto cell = [&](const std::array<double, 3>& x) {
    std::array<std::int64_t, 3> at{};
    for (int d = 0; d < c.dim; ++d) at[2 - d] = static_cast<std::int64_t>(x[d] / c.dx);
    return at;
  };
  std::ranges::stable_sort(points, {}, cell);
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < c.dim; ++d) p.x[d][i] = c.dx / 2 + (1 - c.dx) * points[i][d];
  return made;
}

}  // namespace pairsum

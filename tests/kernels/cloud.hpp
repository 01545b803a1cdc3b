#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <vector>

#include <pairsum/core/random.hpp>
#include "scene.hpp"

namespace pairsum::test_kit {

/// Where the particles of a random cloud lie.
enum class shape { uniform, clustered, coincident, one_cell, line, plane, cell_faces };
inline const std::vector<shape> shapes{shape::uniform, shape::clustered, shape::coincident, shape::one_cell,
                                       shape::line,    shape::plane,     shape::cell_faces};

/// A random cloud, described by a few numbers so that a failing one can be made again.
struct cloud {
  int dim = 3;
  shape form = shape::uniform;
  std::uint32_t fluid = 0, boundary = 0;
  double length = 1;  ///< edge of Omega, in units of H
  double corner = 0;  ///< each component of A, m
  double H = 0.1;     ///< m
  int M = 3;
  std::uint64_t seed = 1;
  std::string grid = "hashed_grid";

  grid_choice choice() const { return {grid, M}; }
};

inline std::ostream& operator<<(std::ostream& o, const cloud& c) {
  return o << "cloud{" << c.dim << "D, shape " << static_cast<int>(c.form) << ", fluid " << c.fluid << ", boundary "
           << c.boundary << ", length " << c.length << " H, corner " << c.corner << ", H " << c.H << ", " << c.grid
           << ", M " << c.M << ", seed " << c.seed << "}";
}

/// Position of particle i as fractions of Omega's edges.
inline std::array<double, 3> place_in(const cloud& c, std::uint64_t i) {
  const counter_random random(c.seed, 1);
  const auto u = [&](std::uint64_t n) { return random.uniform(8 * i + n); };
  const auto center = [&](std::uint64_t n) { return random.uniform(8 * (i % 5) + n + 100000); };
  std::array<double, 3> x;
  for (std::uint64_t d = 0; d < 3; ++d) {
    switch (c.form) {
      case shape::uniform:
        x[d] = u(d);
        break;
      case shape::clustered:
        x[d] = std::min(center(d) + 0.3 / c.length * u(d), 1.0);
        break;
      case shape::coincident:
        x[d] = center(d);
        break;
      case shape::one_cell:
        x[d] = std::min(1.0, 0.5 / c.length * u(d));
        break;
      case shape::line:
        x[d] = d == 0 ? u(0) : 0.5;
        break;
      case shape::plane:
        x[d] = d == 1 ? 0.25 : u(d);
        break;
      case shape::cell_faces:
        x[d] = std::min(1.0, std::floor(u(d) * c.length) / c.length);
        break;
    }
  }
  return x;
}

/// The cloud's particles, fluid first, every mass, density and velocity different, and its world.
inline scene make_cloud(const cloud& c) {
  const counter_random state(c.seed, 2);
  scene s;
  s.world.constants.H = c.H;
  s.world.grid = c.grid;
  s.world.M = c.M;
  const double edge = c.length * c.H;
  s.world.dim = c.dim;
  s.world.omega_low.assign(c.dim, c.corner);
  s.world.omega_high.assign(c.dim, c.corner + edge);
  particle_table& p = s.particles = particle_table(c.dim);
  p.resize(c.fluid + c.boundary);
  for (std::uint64_t i = 0; i < p.size(); ++i) {
    const auto x = place_in(c, i);
    for (std::size_t d = 0; d < s.world.omega_low.size(); ++d) {
      p.x[d][i] = std::min(c.corner + x[d] * edge, s.world.omega_high[d]);
      p.v[d][i] = state.uniform(8 * i + d, -1, 1);
    }
    p.rho[i] = state.uniform(8 * i + 3, 900, 1100);
    p.m[i] = state.uniform(8 * i + 4, 0.5, 2) * 1e-3;
    p.kind[i] = i < c.fluid ? particle_kind::fluid : particle_kind::boundary;
  }
  return s;
}

/// A shuffled order of memory.
inline std::vector<std::uint32_t> shuffled(std::size_t n, std::uint64_t seed) {
  std::vector<std::uint32_t> order(n);
  for (std::uint32_t i = 0; i < n; ++i) order[i] = i;
  const counter_random random(seed, 3);
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.bits(i) % i]);
  return order;
}

}  // namespace pairsum::test_kit

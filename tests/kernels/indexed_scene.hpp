#pragma once
#include <map>

#include <pairsum/grid/hashed_grid.hpp>
#include <pairsum/grid/indexer.hpp>
#include <pairsum/sum/grids.hpp>
#include "scene.hpp"

namespace pairsum::test_kit {

/// A scene's particles, indexed with a grid: what a backend sees, without a backend.
struct indexed_scene {
  box<3, double> omega;
  double cell_width;
  int mask;          ///< of the bits of coordinates that the grid keeps
  ivec<3> period{};  ///< cells of a periodic box
  particle_set<3, double> particles;
  indexer<3, double> index;

  setup world;

  indexed_scene(const scene& s, const grid_choice& grid, const team& t = team())
      : omega(make_box<3, double>(s.world)),
        cell_width(safe_width(omega, s.world.constants.H)),
        mask(grid.M > 0 ? (1 << grid.M) - 1 : -1),
        index(omega, make_grid<3, double>(with(s.world, "naive", grid))),
        world(s.world) {
    period = torus_cells(omega, s.world.constants.H, grid.M > 0 ? 1 << grid.M : 2);
    fill(particles, s.particles);
    index.build(particles, t);
  }

  /// Cell coordinates of particle i from its position alone, folded where the grid folds; of cells cut in `parts` along
  /// each axis.
  std::array<int, 3> cell_of(std::size_t i, int parts = 1) const {
    std::array<int, 3> c;
    for (int d = 0; d < 3; ++d) {
      const double width = period[d] > 0 ? omega.edge(d) / static_cast<double>(period[d]) : cell_width;
      c[d] = static_cast<int>(std::floor((particles.x[d][i] - omega.low[d]) / width * parts)) & mask_of(parts);
    }
    return c;
  }
  /// Where one lands that goes over from a cell, or part of one, to a neighbour.
  std::array<int, 3> turned(std::array<int, 3> c, int parts = 1) const {
    for (int d = 0; d < 3; ++d) {
      const int around = static_cast<int>(period[d]) * parts;
      c[d] = (around > 0 ? (c[d] + around) % around : c[d]) & mask_of(parts);
    }
    return c;
  }
  int mask_of(int parts) const { return mask < 0 ? -1 : (mask + 1) * parts - 1; }
};

}  // namespace pairsum::test_kit

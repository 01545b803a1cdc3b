#pragma once
#include <map>

#include "grid/hashed_grid.hpp"
#include "grid/indexer.hpp"
#include "scene.hpp"
#include "sum/grids.hpp"

namespace pairsum::test_kit {

/// A scene's particles, indexed with a grid: what a backend sees, without a backend.
struct indexed_scene {
  box<3, double> omega;
  double cell_width;
  int mask;  ///< of the bits of coordinates that the grid keeps
  particle_set<3, double> particles;
  indexer<3, double> index;

  indexed_scene(const scene& s, const grid_choice& grid, const team& t = team())
      : omega(make_box<3, double>(s.world)),
        cell_width(hashed_grid<3, double>(omega, s.world.constants.H, 2).cell_width()),
        mask(grid.M > 0 ? (1 << grid.M) - 1 : -1),
        index(omega, make_grid<3, double>(with(s.world, "naive", grid))) {
    fill(particles, s.particles);
    index.build(particles, t);
  }

  /// Cell coordinates of particle i from its position alone, folded where the grid folds; of cells cut in `parts` along
  /// each axis.
  std::array<int, 3> cell_of(std::size_t i, int parts = 1) const {
    std::array<int, 3> c;
    for (int d = 0; d < 3; ++d)
      c[d] = static_cast<int>(std::floor((particles.x[d][i] - omega.low[d]) / cell_width * parts)) &
             (mask < 0 ? -1 : (mask + 1) * parts - 1);
    return c;
  }
};

}  // namespace pairsum::test_kit

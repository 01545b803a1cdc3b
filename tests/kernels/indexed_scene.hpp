#pragma once
#include <map>

#include "grid/hashed_grid.hpp"
#include "grid/indexer.hpp"
#include "scene.hpp"
#include "sum/grids.hpp"

namespace pairsum::test_kit {

/// A scene's particles, indexed with the hashed grid: what a backend sees, without a backend.
struct indexed_scene {
  box<3, double> omega;
  double cell_width;
  int M;
  particle_set<3, double> particles;
  indexer<3, double> index;

  indexed_scene(const scene& s, int bits, const team& t = team())
      : omega(make_box<3, double>(s.world)),
        cell_width(hashed_grid<3, double>(omega, s.world.constants.H, bits).cell_width()),
        M(bits),
        index(omega, std::make_unique<hashed_grid<3, double>>(omega, s.world.constants.H, bits)) {
    fill(particles, s.particles);
    index.build(particles, t);
  }

  /// Folded cell coordinates of particle i from its position alone.
  std::array<int, 3> cell_of(std::size_t i) const {
    std::array<int, 3> c;
    for (int d = 0; d < 3; ++d)
      c[d] = static_cast<int>(std::floor((particles.x[d][i] - omega.low[d]) / cell_width)) & ((1 << M) - 1);
    return c;
  }
};

}  // namespace pairsum::test_kit

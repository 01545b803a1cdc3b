#pragma once
// The serial sweep of SPHysics (Dalrymple et al. 2008): every cell meets itself and its forward neighbours. In 2D:
//
//   (-1,1) (0,1) (1,1)          for each cell I:
//          ( I ) (1,0)            sumF1(I);  for each forward neighbour J:  sumF2(I, J)       3D: 13 forward neighbours
//
// Complete, each pair once; not thread-safe as it stands: patterns of neighbouring cells overlap. Race-free here: one
// thread.
#include "sum/backend.hpp"
#include "sum/scatter_cell.hpp"

namespace pairsum {

struct sphysics_sweep {
  static constexpr backend_traits traits{
      .name = "sphysics_sweep",
      .description = "SPHysics: serial half-stencil sweep over cells; each pair once, both updated",
      .aliases = "half stencil, forward neighbours, linked cells with Newton-3",
      .threads = runtime::serial,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .conflicts = conflict_avoidance::serial};

  template <class I>
  struct workspace {
    template <class Probe>
    void prepare(const problem<I>&, const team&, Probe&) {}

    template <class Probe>
    void sum(const problem<I>& p, const team&, Probe& probe) {
      for (std::size_t cell = 1; cell <= p.cells().fluid_cells; ++cell) {
        mark_unit(probe, 0, cell - 1);
        scatter_cell_in_order(p, cell, probe);
      }
    }
  };
};

}  // namespace pairsum

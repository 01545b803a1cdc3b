#pragma once
// The block pattern of Sbalzarini et al. (J. Comput. Phys. 215 (2006) 566): the pairs of cells are an explicit list,
// applied with every cell as base in one serial sweep:
//
//   for each cell B:  sumF1(B);  for (j, k) in list:  sumF2(B+j, B+k)      3D: 13 pairs among the 8 cells B + {0,1}^3
//
// It is the talk's pattern without the passes: all neighbours of a pair are at or above B, so no cell looks back.
// Blocks of neighbouring bases overlap. Race-free: one thread.
#include "sum/backend.hpp"
#include "sum/block.hpp"

namespace pairsum {

struct ppm_stencil {
  static constexpr backend_traits traits{
      .name = "ppm_stencil",
      .description = "Sbalzarini et al. 2006: the list of cell pairs with every cell as base, one serial sweep",
      .aliases = "PPM, symmetric cell list, Newton-3",
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
    column<block<I::dim>> blocks;

    template <class Probe>
    void prepare(const problem<I>& p, const team&, Probe&) {
      blocks.clear();
      each_block(p.cells(), 1, p.cells().fluid_cells + 1,
                 [&](unsigned, const block<I::dim>& b) { blocks.push_back(b); });
    }

    template <class Probe>
    void sum(const problem<I>& p, const team&, Probe& probe) {
      for (std::size_t k = 0; k < blocks.size(); ++k) {
        mark_unit(probe, 0, k);
        sum_block_of(p, blocks, k, probe);
      }
    }
  };
};

}  // namespace pairsum

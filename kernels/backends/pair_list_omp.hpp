#pragma once
// The list of Liu & Liu made parallel: found by all threads, swept in coloured blocks of cells:
//
//   prepare:  parallel for fluid cells:  list = interacting pairs (i, j) by rows i, each once, found through the cells
//   sum:      for each colour:                       4 in 3D (pencils), 2 in 2D and 1D (slabs); a barrier after each
//               parallel for blocks of the colour:
//                 for cell in block, for i in cell, for j in row i:  c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
//     |## |   |## |   |         blocks ## of a colour; their partners j lie in them or in a cell beside
//
// Race-free: a row's partners lie in the cell of i or in its neighbours, and blocks of a colour are at least two cells
// apart (sum/row_blocks.hpp). Bit-identical for every number of threads: neither rows nor blocks depend on it.
#include "sum/backend.hpp"
#include "sum/row_blocks.hpp"

namespace pairsum {

struct pair_list_omp {
  static constexpr backend_traits traits{
      .name = "pair_list_omp",
      .description = "Liu & Liu's list of interacting pairs, found and swept in parallel: coloured blocks, OpenMP",
      .aliases = "half neighbour list, Verlet list without skin, Newton-3",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = true,
      .loop = {schedule::dynamic, 1},
      .blocks = true,
      .conflicts = conflict_avoidance::colours};

  template <class I>
  struct workspace : row_blocks<I> {
    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe& probe) {
      this->rows.build(p.x, p.cells(), p.fluid_count, p.reach2, p.boundary_reach2, t, probe);
      this->blocks.build(p.cells());
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      this->each_row(p, t, traits.loop, probe, [&](std::uint32_t i) { sum_row(p, this->rows, i, probe); });
    }
  };
};

}  // namespace pairsum

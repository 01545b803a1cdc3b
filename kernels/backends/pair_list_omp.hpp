#pragma once
// The list of Liu & Liu made parallel: found by all threads, swept in coloured blocks of cells:
//
//   prepare:  parallel for fluid cells:  list = interacting pairs (i, j) by rows i, each once, found through the cells
//   sum:      for each colour:                            4 in 3D (pencils), 2 in 2D and 1D (slabs); a barrier after
//   each
//               parallel for blocks of the colour:
//                 for cell in block, for i in cell, for j in row i:  c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
//     |## |   |## |   |         blocks ## of a colour; their partners j lie in them or in a cell beside
//
// Race-free: a row's partners lie in the cell of i or in its neighbours, and blocks of a colour are at least two cells
// apart (sum/cell_blocks.hpp). Bit-identical for every number of threads: neither rows nor blocks depend on it.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/block_setup.hpp"
#include "sum/pair_rows.hpp"

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
  struct workspace {
    pair_rows rows;
    cell_blocks<I::dim> blocks;

    void configure(const setup& s) { shape_blocks(blocks, s, column_bytes_per_cell<I>()); }
    std::string block() const { return blocks.shape().word(); }

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe& probe) {
      rows.build(p.x, p.cells(), p.fluid_count, p.reach2, p.boundary_reach2, t, probe);
      blocks.build(p.cells());
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      for (unsigned colour = 0; colour < blocks.colours(); ++colour)
        omp_pass(colour, blocks.size(colour), g, probe, [&](std::size_t k) {
          for (const std::uint32_t cell : blocks(colour, k)) {
            const cell_range& own = p.cells().range[cell];
            for (std::uint32_t i = own.fluid_begin; i < own.fluid_end; ++i) sum_row(p, rows, i, probe);
          }
        });
    }
  };
};

}  // namespace pairsum

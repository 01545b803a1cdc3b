#pragma once
// Symmetric passes over blocks of cells on vector units, with OpenMP:
//
//   for each colour:                                     2^axes passes, a barrier between them
//     parallel for blocks of the colour:
//       for cell in block, for i in cell:
//         hits = candidates of the own and the forward cells in reach, packed
//         for vectors of hits j:  c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
// Each pair once, both sides updated, lanes full of pairs that interact. Race-free: a block touches its cells and one
// more on either side, and blocks of a colour are at least two cells apart (sum/cell_blocks.hpp). Bit-identical for
// every number of threads: neither blocks nor their colours depend on it.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "vector/tile_workspace.hpp"

namespace pairsum {

struct tiles_omp {
  static constexpr backend_traits traits{
      .name = "tiles_omp",
      .description = "symmetric on vector units: packed pairs, coloured blocks of cells, OpenMP",
      .aliases = "Newton-3 on vector units, blocked half stencil",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::dynamic, 1},
      .vector = true,
      .blocks = true,
      .conflicts = conflict_avoidance::colours};

  template <class I>
  struct workspace : tile_workspace<I, true> {
    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      this->begin_sum(t);
      const granularity g = t.granularity_or(traits.loop);
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      for (unsigned colour = 0; colour < this->colours(); ++colour)
        omp_pass(colour, this->blocks(colour), g, probe,
                 [&](std::size_t k) { this->sum_block(p, colour, k, omp_get_thread_num(), probe); });
    }
  };
};

}  // namespace pairsum

#pragma once
// The gather on vector units, the fair opponent of tiles_omp:
//
//   parallel for blocks of cells:
//     for cell in block, for i in cell:
//       hits = candidates of all 3^d cells in reach, packed
//       for vectors of hits j:  u_i += f(i, j).to_i
//
// Each pair twice. Race-free: a block writes the rates of its own particles alone, and each cell is in one block. The
// blocks are those of tiles_omp, for the cache's sake, in one pass.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "vector/tile_workspace.hpp"

namespace pairsum {

struct naive_tiles_omp {
  static constexpr backend_traits traits{.name = "naive_tiles_omp",
                                         .description = "gather on vector units with OpenMP; each pair is seen twice",
                                         .aliases = "one-sided on vector units, full neighbourhood, no Newton-3",
                                         .threads = runtime::omp,
                                         .symmetric = false,
                                         .deterministic = true,
                                         .accumulates = true,
                                         .evaluations_per_pair = 2,
                                         .sweeps_per_colour = false,
                                         .keeps_pairs = false,
                                         .loop = {schedule::dynamic, 1},
                                         .vector = true,
                                         .blocks = true,
                                         .conflicts = conflict_avoidance::gather};

  template <class I>
  struct workspace : tile_workspace<I, false> {
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

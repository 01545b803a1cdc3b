#pragma once
// The talk's passes with oneTBB (Willkomm 2009; Willkomm & Buecker 2011):
//
//   for o in {0,1}^d:                                    2^d passes; parallel_for returns when a pass is done
//     parallel for base cells B = 2i + o:
//       sumF1(B)
//       for j, k in {0,1}^d, k < j, j*k = 0:  sumF2(B+j, B+k)
//
// Race-free, and bit-identical for every number of threads, as symmetric_omp is: blocks of a pass share no cell.
#include "core/tbb_loop.hpp"
#include "sum/backend.hpp"
#include "sum/block.hpp"

namespace pairsum {

struct symmetric_tbb {
  static constexpr backend_traits traits{
      .name = "symmetric_tbb",
      .description = "the talk's 2^d conflict-free passes over base blocks with oneTBB",
      .aliases = "Newton-3, c08 (eight colours in 3D)",
      .threads = runtime::tbb,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = true,
      .keeps_pairs = false,
      .loop = {schedule::automatic, 32},
      .conflicts = conflict_avoidance::colours};

  template <class I>
  struct workspace : coloured_workspace<I> {
    using coloured_workspace<I>::blocks;

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      t.arena().arena.execute([&] {
        for (unsigned o = 0; o < coloured_blocks<I::dim>::colours; ++o) {
          const auto& b = blocks[o];
          tbb_pass(o, 0, b.size(), g, probe, [&](std::size_t k) { sum_block_of(p, b, k, probe); });
        }
      });
    }
  };
};

}  // namespace pairsum

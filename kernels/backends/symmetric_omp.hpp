#pragma once
// The talk's passes with OpenMP (Willkomm 2009; Willkomm & Buecker 2011):
//
//   for o in {0,1}^d:                                    2^d passes, a barrier after each
//     parallel for base cells B = 2i + o:
//       sumF1(B)
//       for j, k in {0,1}^d, k < j, j*k = 0:  sumF2(B+j, B+k)
//
// Race-free: a block touches its 2^d cells B + {0,1}^d alone. Base cells of a pass have equal parity o, so on a grid of
// even side (2^M, the torus included) two blocks of a pass share no cell; passes are separated by barriers. For the
// same reason the order in which a particle's rate is added to does not depend on the threads: the result is
// bit-identical.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/block.hpp"

namespace pairsum {

struct symmetric_omp {
  static constexpr backend_traits traits{
      .name = "symmetric_omp",
      .description = "the talk's 2^d conflict-free passes over base blocks with OpenMP",
      .aliases = "Newton-3, c08 (eight colours in 3D)",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = true,
      .keeps_pairs = false,
      .loop = {schedule::dynamic, 32},
      .conflicts = conflict_avoidance::colours};

  template <class I>
  struct workspace : coloured_workspace<I> {
    using coloured_workspace<I>::blocks;

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      for (unsigned o = 0; o < coloured_blocks<I::dim>::colours; ++o) {
        const auto& b = blocks[o];
        omp_pass(o, b.size(), g, probe, [&](std::size_t k) { sum_block_of(p, b, k, probe); });
      }
    }
  };
};

}  // namespace pairsum

#pragma once
// The talk's passes, one thread (Willkomm 2009; Willkomm & Buecker 2011). In 2D, o = (0,0), the blocks of a pass:
//
//   +---+---+---+---+     for o in {0,1}^d:                         2^d passes
//   | x   x | x   x |       for base cells B = 2i + o:
//   +  \ /  +  \ /  +         sumF1(B)
//   | B - x | B - x |         for j, k in {0,1}^d, k < j, j*k = 0:  sumF2(B+j, B+k)
//   +---+---+---+---+
//
// Only blocks that hold fluid are listed. Race-free: one thread.
#include "sum/backend.hpp"
#include "sum/block.hpp"

namespace pairsum {

struct symmetric {
  static constexpr backend_traits traits{
      .name = "symmetric",
      .description = "the talk's 2^d passes over base blocks, serial; each pair once, both updated",
      .aliases = "Newton-3, c08 (eight colours in 3D)",
      .threads = runtime::serial,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = true,
      .keeps_pairs = false,
      .conflicts = conflict_avoidance::serial};

  template <class I>
  struct workspace : coloured_workspace<I> {
    using coloured_workspace<I>::blocks;

    template <class Probe>
    void sum(const problem<I>& p, const team&, Probe& probe) {
      for (unsigned o = 0; o < coloured_blocks<I::dim>::colours; ++o)
        for (std::size_t k = 0; k < blocks[o].size(); ++k) sum_block_of(p, blocks[o], k, probe);
    }
  };
};

}  // namespace pairsum

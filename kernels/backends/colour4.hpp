#pragma once
// The talk's base blocks in plus-shaped packs, which need only 4 colours and barriers:
//
//   for each colour:                                      4 in 3D, 3 in 2D, 2 in 1D; a barrier after each
//     parallel for packs of the colour:
//       for base cells B of the pack:
//         sumF1(B)
//         for j, k in {0,1}^d, k < j, j*k = 0:  sumF2(B+j, B+k)
//
//     . A A . . a a .        2D: packs A and a of two colours, a chessboard, and the squares between them (.), which
//     A A A A a a a a        are packs of the third
//     A A A A a a a a
//     . A A . . a a .
//
// Race-free: a pack touches its cells and one more ahead along each axis, and packs of a colour are so far apart, and
// so shaped, that these sets do not meet (sum/coloured_packs.hpp, where it is also checked while colours are given).
// Bit-identical for every number of threads: neither packs nor their colours depend on it.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/coloured_packs.hpp"

namespace pairsum {

struct colour4 {
  static constexpr backend_traits traits{
      .name = "colour4",
      .description = "base blocks in plus-shaped packs, 4 colours in 3D, with OpenMP",
      .aliases = "Newton-3, c04 (AutoPas)",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = true,
      .keeps_pairs = false,
      .loop = {schedule::dynamic, 2},
      .colours = {2, 3, 4},
      .conflicts = conflict_avoidance::colours};

  template <class I>
  struct workspace {
    coloured_packs<I::dim> packs;

    template <class Probe>
    void prepare(const problem<I>& p, const team&, Probe&) {
      packs.build(p.cells());
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      if (packs.colours() > 0) probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      for (unsigned colour = 0; colour < packs.colours(); ++colour)
        omp_pass(colour, packs.size(colour), g, probe, [&](std::size_t pack) {
          const auto [begin, end] = packs(colour, pack);
          for (std::size_t k = begin; k < end; ++k) sum_block_of(p, packs.blocks(), k, probe);
        });
    }
  };
};

}  // namespace pairsum

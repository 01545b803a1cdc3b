#pragma once
// The talk's passes without barriers between them (its author's unpublished variant): each pass adds to a copy of the
// rates of its own, so that passes may run at the same time:
//
//   for o in {0,1}^d:                                    2^d passes; who is done with one begins the next
//     parallel for base cells B = 2i + o:
//       u^o = 0 for the particles of the block B + {0,1}^d
//       sumF1(B), sumF2(B+j, B+k) as in symmetric_omp, adding to u^o
//   one barrier
//   reduce:  u = u^0 + u^1 + ... + u^(2^d - 1)           parallel over particles
//
// Race-free: blocks of a pass share no cell, and passes share no copy. Every cell with fluid lies in exactly one block
// of each pass, so a block can zero its particles itself, while they are in the cache. Bit-identical for every number
// of threads: a block adds up its pairs alone, and copies are joined in the order of the passes.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/block.hpp"
#include "sum/private_columns.hpp"

namespace pairsum {

struct per_pass_buffers {
  static constexpr backend_traits traits{
      .name = "per_pass_buffers",
      .description = "the talk's passes with a copy of the rates each, no barrier between them, then a reduction",
      .aliases = "Newton-3, c08 with a buffer per colour",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::dynamic, 32},
      .colours = {1, 1, 1},
      .conflicts = conflict_avoidance::copies};

  template <class I>
  struct workspace : coloured_workspace<I> {
    using coloured_workspace<I>::blocks;
    static constexpr unsigned passes = coloured_blocks<I::dim>::colours;
    private_columns<I> copies;

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe& probe) {
      coloured_workspace<I>::prepare(p, t, probe);
      copies.resize(passes, p.fluid_count);
    }

    void zero(const problem<I>&, const team&) {}  // blocks do

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      omp_pass_of(0, probe, [&] {
        for (unsigned o = 0; o < passes; ++o) {
          const problem<I> own = copies.with_copy(p, o);
          const auto& b = blocks[o];
          omp_share(0, b.size(), g, probe, [&](std::size_t k) {
            for (const std::uint32_t cell : b[k]) {
              const cell_range& range = p.cells().range[cell];
              zero_range(own.u, range.fluid_begin, range.fluid_end);
            }
            sum_block_of(own, b, k, probe);
          });
        }
      });
    }

    void reduce(const problem<I>& p, const team& t) { copies.join(p, t); }
  };
};

}  // namespace pairsum

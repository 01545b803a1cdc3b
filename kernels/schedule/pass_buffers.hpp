#pragma once
// The talk's passes without barriers between them (its author's unpublished variant): each pass adds to a copy of the
// rates of its own, so that passes may run at the same time:
//
//   for o in {0,1}^d:                                    2^d passes; a thread that finishes one begins the next
//     parallel for base cells B = 2i + o:
//       u^o = 0 for the particles of the block B + {0,1}^d
//       sumF1(B), sumF2(B+j, B+k) as in symmetric_omp, adding to u^o
//   one barrier
//   reduce:  u = u^0 + u^1 + ... + u^(2^d - 1)           parallel over particles
//
// Race-free: blocks of a pass share no cell, and passes share no copy. Every cell with fluid lies in exactly one block
// of each pass, so a block can zero its particles itself, while they are in the cache; but around an axis of 3 cells a
// pass leaves cells out, and copies are zeroed beforehand. Bit-identical for every number of threads: one thread sums
// each block, and copies are reduced in the order of the passes.
#include <algorithm>

#include <pairsum/schedule/block.hpp>
#include <pairsum/sum/rate_copies.hpp>

namespace pairsum {

template <int D, class R>
class pass_buffers final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "the talk's passes with a copy of the rates each, no barrier between them, then a reduction",
      .aliases = "Newton-3, c08 with a buffer per colour",
      .loop = {loop_schedule::dynamic, 32},
      .conflicts = conflict_avoidance::copies};

  void prepare(const P& p, const team& t) override {
    blocks_.build(p.cells(), t);
    passes_ = blocks_.colours();
    copies_.resize(passes_, p);
    end_[0] = 0;
    for (unsigned o = 0; o < passes_; ++o) end_[o + 1] = end_[o] + blocks_[o].size();
  }
  void zero(const P& p, const team& t) override {
    if (passes_ == pattern::block_cells<D>) return;  // blocks do
    t.for_pieces(p.fluid_count, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (unsigned o = 0; o < passes_; ++o) p.pairs->zero(copies_.of(p, o), begin, end);
    });
  }
  /// Blocks pass after pass.
  std::size_t size(const P&, unsigned) const override { return end_[passes_]; }
  void unit(const P& p, unsigned, std::size_t k, int thread) override {
    const auto o =
        static_cast<unsigned>(std::upper_bound(end_.begin() + 1, end_.begin() + 1 + passes_, k) - (end_.begin() + 1));
    const auto& blocks = blocks_[o];
    k -= end_[o];
    const target to{.u = copies_.of(p, o), .thread = thread};
    for (const std::uint32_t cell : blocks[k]) {
      const cell_range& range = p.cells().range[cell];
      p.pairs->zero(to.u, range.fluid.begin, range.fluid.end);
    }
    sum_block_of(p, blocks, k, to);
  }
  void reduce(const P& p, const team& t) override { copies_.join(p, t); }

 private:
  coloured_blocks<D> blocks_;
  rate_copies<D, R> copies_;
  unsigned passes_ = 0;
  std::array<std::size_t, coloured_blocks<D>::most_colours + 1> end_{};
};

}  // namespace pairsum

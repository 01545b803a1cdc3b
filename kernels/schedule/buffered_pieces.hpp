#pragma once
// Half-stencil sweeps over pieces of the cells, with private buffers for the few particles that two pieces write to:
//
//   prepare:  cut the cells into pieces; list the blocks of 64 particles that each piece writes to
//   sum:      parallel for pieces:
//               buffers of the piece = 0
//               for i in piece, for j within H of i, later in its cell or in a forward neighbour:
//                 c = f(i, j), added to the buffer if another piece writes to the block, else to the rates
//   reduce:   parallel for blocks with buffers:  u += the buffers, in the order of the pieces
//
//     piece 1  [####====]                 =  blocks that two pieces write to: only these have buffers, are zeroed and
//     piece 2      [====####====]            added up
//     piece 3              [====####]
//
// Race-free: a block without buffers has one writer, and a buffer belongs to one piece. Bit-identical for every number
// of threads: pieces depend on the particles alone, and buffers are added up in their order.
#include <pairsum/schedule/cell_sweep.hpp>
#include <pairsum/schedule/touched_pieces.hpp>
#include <pairsum/sum/rate_copies.hpp>

namespace pairsum {

template <int D, class R>
class buffered_pieces final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "sweeps over pieces; what several touch is buffered in blocks and reduced in order",
      .aliases = "Newton-3, ordered reduction of touched blocks (GROMACS nbnxm)",
      .loop = {loop_schedule::dynamic, 1},
      .conflicts = conflict_avoidance::copies};

  void prepare(const P& p, const team& t) override {
    pieces_.build(p.cells(), p.fluid_count, t);
    buffer_.resize(p.pairs->rate_bytes, pieces_.slots() * split_block);
    slots_.resize(static_cast<std::size_t>(t.threads()));
    // Behind the fluid are the spare rows of vector units.
    for (auto& slots : slots_) slots.assign(p.rate_rows() / split_block + 1, unsplit);
  }
  std::size_t size(const P&, unsigned) const override { return pieces_.size(); }
  void unit(const P& p, unsigned, std::size_t k, int thread) override {
    auto& slots = slots_[static_cast<std::size_t>(thread)];
    const target to{p.u, update::split, thread, buffer_.view(), slots.data()};
    for (const auto& touched : pieces_[k].touched) {
      slots[touched.block] = touched.slot;
      if (touched.slot != unsplit)
        p.pairs->zero(to.buffer, touched.slot * split_block, (touched.slot + 1) * split_block);
    }
    sweep_cells(p, pieces_[k].cell_begin, pieces_[k].cell_end, to);
  }
  void reduce(const P& p, const team& t) override {
    t.for_pieces(pieces_.blocks(), [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t b = begin; b < end; ++b)
        for (std::size_t slot = pieces_.first_slot(b); slot < pieces_.first_slot(b + 1); ++slot)
          p.pairs->add(p.u, b * split_block, buffer_.view(), slot * split_block,
                       std::min(split_block, p.fluid_count - b * split_block));
    });
  }

 private:
  touched_pieces<D> pieces_;
  rate_copy buffer_;
  std::vector<std::vector<std::uint32_t>> slots_;  ///< by block, of a thread's piece
};

}  // namespace pairsum

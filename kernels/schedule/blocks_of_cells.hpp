#pragma once
// Symmetric passes over blocks of cells, made for vector units:
//
//   for each colour:                                     2^axes passes, a barrier between them
//     parallel for blocks of the colour:
//       for cell in block, for i in cell:
//         hits = candidates of the own and the forward cells within the cutoff, packed
//         for vectors of hits j:  c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
// Each pair once, both sides updated, lanes full of pairs that interact. Race-free: a block touches its cells and one
// more on either side, and blocks of a colour are at least two cells apart (schedule/cell_blocks.hpp). Bit-identical
// for every number of threads: neither blocks nor their colours depend on it.
//
// The gather on vector units, the baseline for tiles_*:
//
//   parallel for blocks of cells:
//     for cell in block, for i in cell:
//       hits = candidates of all 3^d cells within the cutoff, packed
//       for vectors of hits j:  u_i += f(i, j).to_i
//
// Each pair twice. Race-free: a block writes only the rates of its own particles, and each cell is in one block. The
// blocks are those of tiles_*, since they suit the cache, in one pass.
#include <pairsum/schedule/block_setup.hpp>
#include <pairsum/sum/prefetch.hpp>

#include <pairsum/sum/schedule.hpp>

namespace pairsum {

template <int D, class R, bool symmetric>
class blocks_of_cells : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  void configure(const setup& s, std::size_t cell_bytes) override { shape_blocks(blocks_, s, cell_bytes, !symmetric); }
  std::string block() const override { return blocks_.shape().word(); }
  void prepare(const P& p, const team&) override { blocks_.build(p.cells()); }
  unsigned colours(const P&) const override { return blocks_.colours(); }
  std::size_t size(const P&, unsigned colour) const override { return blocks_.size(colour); }
  void unit(const P& p, unsigned colour, std::size_t k, int thread) override {
    const auto cell = blocks_(colour, k);
    sum_cells(p, p.to(thread), symmetric ? partners::later : partners::others, cell.data(), cell.size());
  }

 private:
  cell_blocks<D> blocks_;
};

template <int D, class R>
struct symmetric_tiles final : blocks_of_cells<D, R, true> {
  static constexpr backend_traits traits{.description = "packed pairs in coloured blocks of cells, on vector units",
                                         .aliases = "Newton-3 on vector units, blocked half stencil",
                                         .loop = {loop_schedule::dynamic, 1},
                                         .vector = true,
                                         .blocks = true};
};

template <int D, class R>
struct gather_tiles final : blocks_of_cells<D, R, false> {
  static constexpr backend_traits traits{
      .description = "gather over blocks of cells on vector units; each pair is seen twice",
      .aliases = "one-sided on vector units, full neighbourhood, no Newton-3",
      .symmetric = false,
      .loop = {loop_schedule::dynamic, 1},
      .vector = true,
      .blocks = true,
      .conflicts = conflict_avoidance::gather};
};

}  // namespace pairsum

#pragma once
#include <array>
#include <vector>

#include <pairsum/core/places.hpp>
#include <pairsum/core/team.hpp>
#include <pairsum/pattern/axis_colours.hpp>
#include <pairsum/sum/prefetch.hpp>
#include <pairsum/sum/schedule.hpp>

namespace pairsum {

/// The 2^d cells of a base block: cell B + o for every offset o in {0,1}^d, 0 where it is empty.
template <int D>
using block = std::array<std::uint32_t, pattern::block_cells<D>>;

namespace block_detail {

/// Bits of the neighbour table: members of the block that come before code `own`, seen from that cell.
template <int D>
constexpr auto make_earlier() {
  std::array<std::uint32_t, pattern::block_cells<D>> mask{};
  for (unsigned own = 0; own < pattern::block_cells<D>; ++own)
    for (unsigned other = 0; other < own; ++other) mask[own] |= std::uint32_t{1} << pattern::step_code<D>(own, other);
  return mask;
}
template <int D>
inline constexpr auto earlier = make_earlier<D>();

}  // namespace block_detail

/// Every base block that holds fluid, once. Blocks are found from the cells with fluid, not by walking the grid, so
/// empty cells cost nothing: each block is listed by the first of its cells that has fluid. Calls emit(parity o of B,
/// block) for the blocks of fluid cells [begin, end), in ascending order.
template <int D, class Emit>
void each_block(const cells<D>& c, std::size_t begin, std::size_t end, Emit&& emit) {
  static_assert(D <= 3, "the neighbours of a cell are kept as bits of a 32-bit word");
  for (std::size_t cell = begin; cell < end; ++cell) {
    const std::uint32_t* const around = c.neighbours_of(cell);
    std::uint32_t has_fluid = 0;
    for (unsigned n = 0; n < cells<D>::stencil; ++n)
      has_fluid |= static_cast<std::uint32_t>(around[n] - 1 < c.fluid_cells) << n;
    for (unsigned own = 0; own < pattern::block_cells<D>; ++own) {
      if (has_fluid & block_detail::earlier<D>[own]) continue;
      block<D> members;
      for (unsigned o = 0; o < pattern::block_cells<D>; ++o) members[o] = around[pattern::step_code<D>(own, o)];
      emit(c.colour[cell] ^ own, members);
    }
  }
}

/// Coordinates of the base cell of a block with fluid, which may be empty: -1 at the least.
template <int D>
ivec<D> base_of(const block<D>& members, const cells<D>& c) {
  unsigned o = 0;
  while (members[o] - 1 >= c.fluid_cells) ++o;
  ivec<D> base = c.place[members[o]];
  for (int d = 0; d < D; ++d) base[d] -= o >> d & 1;
  return base;
}

/// each_block() with colours (pattern::block_colour): blocks of a colour share no cell. They are the parities, unless
/// an axis closes on itself after an odd number of cells.
template <int D, class Emit>
void each_coloured_block(const cells<D>& c, std::size_t begin, std::size_t end, Emit&& emit) {
  if (pattern::block_colours(c.period) == pattern::block_cells<D>) return each_block(c, begin, end, emit);
  each_block(c, begin, end, [&](unsigned, const block<D>& b) {
    ivec<D> base = base_of<D>(b, c);
    for (int d = 0; d < D; ++d) base[d] = c.period[d] > 0 ? turned(base[d], c.period[d]) : base[d] + 2;
    emit(pattern::block_colour(base, c.period), b);
  });
}

/// What sum_block() does with pairs of cells.
template <int D>
void count_cell_pairs(const cells<D>& c, const block<D>& members, work_counts& counts) {
  constexpr unsigned n = pattern::block_cells<D>;
  const auto is_fluid = [&](unsigned j) { return c.range[members[j]].fluid.size() > 0; };
  counts.sumF1 += is_fluid(0);
  for (unsigned j = 0; j < n; ++j)
    for (unsigned k = 0; k < n; ++k)  // with a later cell, or with one without fluid, which opens no pairs itself
      counts.sumF2 += is_fluid(j) && (j & k) == 0 && k != j && members[k] != 0 && (k > j || !is_fluid(k));
}

/// sumF1(B) and the sumF2 of the pattern, as b(d)+1 cell pairs grouped by their lower cell: particle i of cell j meets
/// all later cells k with j & k == 0 at once. Touches fluid particles of the block's cells and no others.
template <int D, class R>
void sum_block(const problem<D, R>& p, const block<D>& members, const target& to) {
  constexpr unsigned n = pattern::block_cells<D>;
  const auto& range = p.cells().range;
  meeting<D> all[n];
  unsigned size = 0;
  for (unsigned j = 0; j < n; ++j) {
    const cell_range& own = range[members[j]];
    if (own.fluid.size() == 0) continue;
    meeting<D>& m = all[size];
    m.start(own, j == 0 ? partners::later : partners::all);
    for (unsigned k = 0; k < n; ++k) {
      if ((j & k) != 0) continue;
      const cell_range& other = range[members[k]];
      if (k > j) m.fluid.add(other.fluid);
      m.boundary.add(other.boundary);
    }
    size += !m.empty();  // one that is not kept serves for the next
  }
  if (p.counts != nullptr) [[unlikely]]
    count_cell_pairs(p.cells(), members, *p.counts);
  sum_meetings<D, R>(p, p, to, all, size);
}

/// sum_block() for number k of a list of blocks, of which a thread sums many one after the other.
template <int D, class R>
inline void sum_block_of(const problem<D, R>& p, const column<block<D>>& blocks, std::size_t k, const target& to) {
  fetch_next_block(p, blocks, k, to);
  sum_block(p, blocks[k], to);
}

/// The blocks of each colour.
template <int D>
class coloured_blocks {
 public:
  static constexpr unsigned most_colours = pattern::stencil_cells<D>;  ///< three along each axis

  /// The same lists in the same order for every team.
  void build(const cells<D>& c, const team& t);

  unsigned colours() const { return colours_; }
  const column<block<D>>& operator[](unsigned colour) const { return blocks_[colour]; }

 private:
  unsigned colours_ = 0;
  std::array<column<block<D>>, most_colours> blocks_;
};

#define PAIRSUM_COLOURED_BLOCKS(D) extern template class coloured_blocks<D>;
PAIRSUM_EACH_D(PAIRSUM_COLOURED_BLOCKS)
#undef PAIRSUM_COLOURED_BLOCKS

}  // namespace pairsum

#pragma once
#include <pairsum/sum/problem.hpp>

/// Software prefetch of particles before their pairs are due. A sum reads some twenty columns in several rows of
/// cells at once, more than hardware prefetchers follow: the talk's passes over a million particles take 1.4 times as
/// long without. Occasionally the next unit of a list belongs to another thread.
namespace pairsum {

/// For a sum cell by cell in the order of the grid: of the cell after `cell` the neighbours one step ahead along the
/// first axis, along which cells follow each other; the others were near `cell`. `half`: of the half stencil, whose
/// rates are added to, those of `to`.
template <bool half, int D, class R>
[[gnu::always_inline]] inline void fetch_for_next_cell(const problem<D, R>& p, std::size_t cell, const target& to) {
  const cells<D>& c = p.cells();
  if (cell >= c.fluid_cells) return;
  std::uint32_t ahead[pattern::stencil_cells<D>];
  unsigned n = 0;
  pattern::each_ahead<D, half>([&](unsigned code)
                                   __attribute__((always_inline)) { ahead[n++] = c.neighbour(cell + 1, code); });
  p.pairs->fetch(p, ahead, n, half ? &to.u : nullptr);
}

/// For a pass over a list of blocks: the cells of the one behind number k, and where those of a later one are.
template <int D, class R, class Blocks>
[[gnu::always_inline]] inline void fetch_next_block(const problem<D, R>& p, const Blocks& blocks, std::size_t k,
                                                    const target& to) {
  if (k + 3 < blocks.size())
    for (const std::uint32_t cell : blocks[k + 3]) __builtin_prefetch(&p.cells().range[cell]);
  if (k + 1 < blocks.size())
    p.pairs->fetch(p, blocks[k + 1].data(), static_cast<unsigned>(blocks[k + 1].size()), &to.u);
}

/// For a pass over a list of cells: one that is due soon, with its forward neighbours.
template <int D, class R>
[[gnu::always_inline]] inline void fetch_half_stencil(const problem<D, R>& p, std::size_t cell, const target& to) {
  constexpr unsigned centre = pattern::stencil_centre<D>;
  p.pairs->fetch(p, p.cells().neighbours_of(cell) + centre, pattern::stencil_cells<D> - centre, &to.u);
}

/// For a sweep over cell[0..n), at number k: what is near the next cell and not near this one, if cells come row after
/// row; and where those of later cells are. Which particles are read depends on the distance test, so hardware
/// cannot predict them.
template <bool half, int D, class R>
[[gnu::always_inline]] inline void fetch_in_list(const problem<D, R>& p, const std::uint32_t* cell, std::size_t n,
                                                 std::size_t k, const target& to) {
  const cells<D>& c = p.cells();
  if (k + 1 == n) return;
  const std::uint32_t* const soon = c.neighbours_of(cell[k + 4 < n ? k + 4 : n - 1]);
  __builtin_prefetch(soon + pattern::stencil_centre<D>);
  __builtin_prefetch(soon + pattern::stencil_cells<D> - 1);
  const std::uint32_t* const later = c.neighbours_of(cell[k + 2 < n ? k + 2 : n - 1]);
  const std::uint32_t* const next = c.neighbours_of(cell[k + 1]);
  std::uint32_t ahead[pattern::stencil_cells<D>];
  unsigned m = 0;
  pattern::each_ahead<D, half>([&](unsigned code) __attribute__((always_inline)) {
    __builtin_prefetch(&c.range[later[code]]);
    ahead[m++] = next[code];
  });
  p.pairs->fetch(p, ahead, m, half ? &to.u : nullptr);
}

}  // namespace pairsum

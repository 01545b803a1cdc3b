#pragma once
#include <cstddef>
#include <cstdint>

#include "core/same_code.hpp"
#include "pattern/pattern.hpp"
#include "sum/problem.hpp"

/// Asking memory for particles before their pairs are due. A sum goes through some twenty columns in several rows of
/// cells at once, more than processors foresee: the talk's passes over a million particles take 1.4 times as long
/// without. Now and then what comes next in a list is another thread's.
///
/// Functions that do nothing else have no effect for g++, which leaves out their calls. So all are inlined into a few
/// that compilers may not look into.
namespace pairsum {

/// The first and last of a cell's fluid: its columns are a cache line or two each.
template <bool with_rates, class I>
[[gnu::always_inline]] inline void fetch_columns(const problem<I>& p, std::uint32_t cell) {
  const cell_range& range = p.cells().range[cell];
  if (range.fluid() == 0) return;
  const auto ends_of = [&](const void* column, std::size_t size) __attribute__((always_inline)) {
    const auto* const bytes = static_cast<const std::byte*>(column);
    __builtin_prefetch(bytes + range.fluid_begin * size);
    __builtin_prefetch(bytes + (range.fluid_end - 1) * size);
  };
  for (const auto* const column : p.x.column) ends_of(column, sizeof *column);
  each_scalar(
      zero<particle_of<I>>(), [&](const auto& a, int slot)
                                  __attribute__((always_inline)) { ends_of(p.fluid.begin[slot], sizeof a); });
  if constexpr (with_rates)
    each_scalar(
        zero<rates_of<I>>(), [&](const auto& a, int slot)
                                 __attribute__((always_inline)) { ends_of(p.u.begin[slot], sizeof a); });
}

/// For a sum cell by cell in the order of the grid: of the cell after `cell` the neighbours one step ahead along the
/// first axis, along which cells follow each other; the others were near `cell`. `half`: of the half stencil, whose
/// rates are added to.
template <bool half, class I>
PAIRSUM_SAME_CODE void fetch_for_next_cell(const problem<I>& p, std::size_t cell) {
  const cells<I::dim>& c = p.cells();
  if (cell >= c.fluid_cells) return;
  pattern::each_ahead<I::dim, half>([&](unsigned code) __attribute__((always_inline)) {
    fetch_columns<half>(p, c.neighbour(cell + 1, code));
  });
}

/// For a pass over a list of blocks: the cells of the one behind number k, and where those of a later one are.
template <class I, class Blocks>
PAIRSUM_SAME_CODE void fetch_next_block(const problem<I>& p, const Blocks& blocks, std::size_t k) {
  if (k + 3 < blocks.size())
    for (const std::uint32_t cell : blocks[k + 3]) __builtin_prefetch(&p.cells().range[cell]);
  if (k + 1 < blocks.size())
    for (const std::uint32_t cell : blocks[k + 1]) fetch_columns<true>(p, cell);
}

/// For a pass over a list of cells: one that is due soon, with its forward neighbours.
template <class I>
PAIRSUM_SAME_CODE void fetch_half_stencil(const problem<I>& p, std::size_t cell) {
  for (unsigned code = pattern::stencil_centre<I::dim>; code < pattern::stencil_cells<I::dim>; ++code)
    fetch_columns<true>(p, p.cells().neighbour(cell, code));
}

}  // namespace pairsum

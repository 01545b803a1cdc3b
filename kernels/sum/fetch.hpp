#pragma once
#include <cstddef>
#include <cstdint>

#include "pattern/pattern.hpp"
#include "sum/problem.hpp"

/// Asking memory for particles before their pairs are due. A sum goes through some twenty columns in several rows of
/// cells at once, more than processors foresee: the talk's passes over a million particles take 1.4 times as long
/// without.
namespace pairsum {

/// The first and last of a cell's fluid: its columns are a cache line or two each.
template <class I>
[[gnu::always_inline]] inline void fetch_fluid(const problem<I>& p, std::uint32_t cell, bool with_rates) {
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
  if (with_rates)
    each_scalar(
        zero<rates_of<I>>(), [&](const auto& a, int slot)
                                 __attribute__((always_inline)) { ends_of(p.u.begin[slot], sizeof a); });
}

/// For a sweep along the first axis, along which rows of cells lie in memory: of the cell that comes after `cell` the
/// neighbours one step ahead; the others were near the cell before. `forward`: of the half stencil alone.
template <class I>
[[gnu::always_inline]] inline void fetch_for_next(const problem<I>& p, std::size_t cell, bool forward) {
  constexpr unsigned stencil = cells<I::dim>::stencil, centre = pattern::stencil_centre<I::dim>;
  const cells<I::dim>& c = p.cells();
  if (cell >= c.fluid_cells) return;
  // Codes of neighbours count the first axis fastest: every third is one step ahead.
  for (unsigned n = forward ? centre + 1 : 2; n < stencil; n += 3) fetch_fluid(p, c.neighbour(cell + 1, n), forward);
}

/// For a pass over a list of blocks: the cells of the one behind number k, and where those of a later one are.
template <class I, class Blocks>
[[gnu::always_inline]] inline void fetch_next_block(const problem<I>& p, const Blocks& blocks, std::size_t k) {
  if (k + 3 < blocks.size())
    for (const std::uint32_t cell : blocks[k + 3]) __builtin_prefetch(&p.cells().range[cell]);
  if (k + 1 < blocks.size())
    for (const std::uint32_t cell : blocks[k + 1]) fetch_fluid(p, cell, true);
}

}  // namespace pairsum

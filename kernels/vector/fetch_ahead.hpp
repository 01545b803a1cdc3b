#pragma once
#include <algorithm>

#include "vector/tile_problem.hpp"

namespace pairsum {

/// Asks memory for what a sweep over `cell[0..n)` reads soon, when it is at number k: of the cell after it the
/// particles of the neighbours one step ahead along the first axis, along which rows of cells lie in memory; the others
/// were near the cell before. Where they are is asked for two and four cells ahead. A row of particles is read where a
/// hit points, which the processor cannot foresee: without this, a million particles take 1.4 times as long.
template <bool symmetric, class I>
[[gnu::always_inline]] inline void fetch_ahead(const tile_problem<I>& t, const std::uint32_t* cell, std::size_t n,
                                               std::size_t k) {
  constexpr unsigned stencil = cells<I::dim>::stencil, centre = pattern::stencil_centre<I::dim>;
  // Codes of neighbours count the first axis fastest: every third is one step ahead. The half stencil begins with the
  // one ahead of the cell itself.
  constexpr unsigned first = symmetric ? centre + 1 : 2;
  static_assert(first % 3 == 2);
  const cells<I::dim>& c = t.p->cells();
  const auto neighbours = [&](std::size_t ahead) { return c.neighbours_of(cell[std::min(k + ahead, n - 1)]); };
  __builtin_prefetch(neighbours(4) + first);
  __builtin_prefetch(neighbours(4) + stencil - 1);
  for (unsigned m = first; m < stencil; m += 3) __builtin_prefetch(&c.range[neighbours(2)[m]]);
  for (unsigned m = first; m < stencil; m += 3) {
    const cell_range& near = c.range[neighbours(1)[m]];
    const auto* const end = reinterpret_cast<const std::byte*>(t.row(near.fluid_end));
    for (const auto* at = reinterpret_cast<const std::byte*>(t.row(near.fluid_begin)); at < end; at += 64)
      __builtin_prefetch(at);
    for (const std::int32_t* const place : t.place) __builtin_prefetch(place + near.fluid_end);
  }
}

}  // namespace pairsum

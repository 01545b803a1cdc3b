#pragma once
// A cell's step of a half-stencil sweep: all pairs in it and with its forward neighbours, both sides updated. Touches
// fluid particles of these cells and no others.
#include <pairsum/sum/prefetch.hpp>
#include <pairsum/sum/schedule.hpp>

namespace pairsum {

template <int D, class R>
inline void sweep_cell(const problem<D, R>& p, std::size_t cell, const target& to) {
  sum_meetings(p, to, half_stencil(p.cells(), cell, p.counts));
}

/// sweep_cell() for one of many cells that are summed in the order of the grid.
template <int D, class R>
inline void sweep_cell_in_order(const problem<D, R>& p, std::size_t cell, const target& to) {
  fetch_for_next_cell<true>(p, cell, to);
  sweep_cell(p, cell, to);
}

/// The serial half-stencil sweep over fluid cells [begin, end), in the order of the grid.
template <int D, class R>
void sweep_cells(const problem<D, R>& p, std::size_t begin, std::size_t end, const target& to) {
  for (std::size_t cell = begin; cell < end; ++cell) sweep_cell_in_order(p, cell, to);
}

}  // namespace pairsum

#pragma once
#include "core/same_code.hpp"
#include "sum/fetch.hpp"
#include "sum/half_stencil.hpp"

namespace pairsum {

/// A cell's step of a half-stencil sweep: all pairs in it and with its forward neighbours, both sides updated. Touches
/// fluid particles of these cells and no others.
template <class I, class Probe>
PAIRSUM_SAME_CODE void scatter_cell(const problem<I>& p, std::size_t cell, Probe& probe) {
  sweep_cell<I::dim>(p.cells(), cell, probe, [&](std::uint32_t i, const auto& fluid, const auto& boundary) {
    scatter_one(p, i, fluid, boundary, probe);
  });
}

/// scatter_cell() for one of many cells that are summed in the order of the grid.
template <class I, class Probe>
[[gnu::always_inline]] inline void scatter_cell_in_order(const problem<I>& p, std::size_t cell, Probe& probe) {
  fetch_for_next_cell<true>(p, cell);
  scatter_cell(p, cell, probe);
}

}  // namespace pairsum

#pragma once
#include "core/same_code.hpp"
#include "sum/fetch.hpp"
#include "sum/one_against_many.hpp"

namespace pairsum {

/// Every fluid particle of a cell collects from the 3^d cells around it. Writes the rates of this cell's particles
/// alone.
template <class I, class Probe>
PAIRSUM_SAME_CODE void gather_cell(const problem<I>& p, std::size_t cell, Probe& probe) {
  constexpr unsigned stencil = cells<I::dim>::stencil;
  const auto& c = p.cells();
  const cell_range& own = c.range[cell];
  range_list<stencil> around, boundary;
  for (unsigned n = 0; n < stencil; ++n) {
    const cell_range& other = c.range[c.neighbour(cell, n)];
    around.add(other.fluid_begin, other.fluid_end);
    boundary.add(other.boundary_begin, other.boundary_end);
  }
  for (std::uint32_t i = own.fluid_begin; i < own.fluid_end; ++i) {
    range_list<stencil + 1> others;  // all but i itself
    for (const index_range& r : around) {
      if (i < r.begin || i >= r.end) {
        others.add(r.begin, r.end);
      } else {
        others.add(r.begin, i);
        others.add(i + 1, r.end);
      }
    }
    gather_one(p, i, others, boundary, probe);
  }
}

/// gather_cell() for one of many cells that are summed in the order of the grid.
template <class I, class Probe>
[[gnu::always_inline]] inline void gather_cell_in_order(const problem<I>& p, std::size_t cell, Probe& probe) {
  fetch_for_next_cell<false>(p, cell);
  gather_cell(p, cell, probe);
}

}  // namespace pairsum

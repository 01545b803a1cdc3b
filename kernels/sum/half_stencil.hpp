#pragma once
#include "sum/one_against_many.hpp"

namespace pairsum {

/// The pairs one fluid cell opens in a serial sweep with a half stencil: its fluid against the fluid of the (3^d - 1)/2
/// forward neighbours, and against the boundary of all neighbours (a boundary cell opens no pairs of its own, so both
/// sides are taken here). Calls visit(i, fluid_ranges, boundary_ranges) for every fluid particle i of the cell.
template <int D, class Probe, class Visit>
[[gnu::always_inline]] inline void sweep_cell(const cells<D>& c, std::size_t cell, Probe& probe, Visit&& visit) {
  constexpr unsigned centre = pattern::stencil_centre<D>;
  const cell_range& own = c.range[cell];
  range_list<centre> forward;
  range_list<cells<D>::stencil> boundary;
  for (unsigned n = 0; n < cells<D>::stencil; ++n) {
    const cell_range& other = c.range[c.neighbour(cell, n)];
    boundary.add(other.boundary_begin, other.boundary_end);
    if (n > centre) forward.add(other.fluid_begin, other.fluid_end);
    if constexpr (Probe::counting) {
      // a forward neighbour, or a backward one without fluid, which does not open the pair itself
      probe.sumF2(n != centre && c.neighbour(cell, n) != 0 && (n > centre || other.fluid() == 0));
      probe.sumF1(n == centre);
    }
  }
  for (std::uint32_t i = own.fluid_begin; i < own.fluid_end; ++i) {
    range_list<centre + 1> fluid;
    fluid.add(i + 1, own.fluid_end);
    for (const index_range& r : forward) fluid.add(r.begin, r.end);
    visit(i, fluid, boundary);
  }
}

}  // namespace pairsum

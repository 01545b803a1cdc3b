#pragma once
#include <array>

#include <pairsum/core/team.hpp>
#include <pairsum/grid/cells.hpp>

namespace pairsum {

/// Positions and neighbours of the fluid cells of a grid that closes on itself along axes with a `period`: place_of(c)
/// is where fluid cell c is, part(d, a) what coordinate a along axis d adds to a cell's key, table[key] the cell.
template <int D, class Place, class Part>
void connect_torus(const ivec<D>& period, const std::uint32_t* table, cells<D>& c, const team& t, Place&& place_of,
                   Part&& part) {
  constexpr unsigned stencil = cells<D>::stencil;
  c.period = period;
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t cell = begin + 1; cell <= end; ++cell) {
      const ivec<D> at = place_of(cell);
      c.set_place(cell, at);
      std::array<std::array<std::uint32_t, 3>, D> parts;  // of the left, own and right coordinate of each axis
      for (int d = 0; d < D; ++d) {
        parts[d][0] = part(d, turned(at[d] - 1, period[d]));
        parts[d][1] = part(d, at[d]);
        parts[d][2] = part(d, turned(at[d] + 1, period[d]));
      }
      for (unsigned n = 0; n < stencil; ++n) {
        std::uint32_t key = 0;
        for (unsigned d = 0, code = n; d < D; ++d, code /= 3) key += parts[d][code % 3];
        c.neighbours[cell * stencil + n] = table[key];
      }
    }
  });
}

}  // namespace pairsum

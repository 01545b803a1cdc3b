#pragma once
#include <algorithm>
#include <array>
#include <span>

#include "core/team.hpp"
#include "grid/cells.hpp"

namespace pairsum {

/// Fills the neighbours of all fluid cells by walking the ascending list `sorted` of the places of all non-empty cells,
/// number[k] being the cell at sorted[k]. at(c) is the place of fluid cell c, ascending with c; shifted(place, dx, row)
/// is the place dx cells along x in row `row` (a base-3 code of the other components' steps, as in a stencil code).
///
/// The row of three cells around a cell moves through the list as the cell does, so each of the 3^(D-1) rows keeps a
/// finger in the list: no table, nothing costs more than the cells that exist.
template <int D, class Place, class At, class Shifted>
void connect_sorted(std::span<const Place> sorted, std::span<const std::uint32_t> number, cells<D>& c, const team& t,
                    At&& at, Shifted&& shifted) {
  constexpr unsigned stencil = cells<D>::stencil, rows = stencil / 3;
  constexpr std::size_t leap = 16;  // beyond so many steps a binary search is faster
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::array<std::size_t, rows> finger{};
    for (std::size_t cell = begin + 1; cell <= end; ++cell)
      for (unsigned row = 0; row < rows; ++row) {
        const Place left = shifted(at(cell), -1, row);
        std::size_t k = finger[row];
        if (k + leap < sorted.size() && sorted[k + leap] < left)
          k = static_cast<std::size_t>(
              std::lower_bound(sorted.begin() + static_cast<std::ptrdiff_t>(k + leap), sorted.end(), left) -
              sorted.begin());
        while (k < sorted.size() && sorted[k] < left) ++k;
        finger[row] = k;
        for (int dx = -1; dx <= 1; ++dx) {
          const bool found = k < sorted.size() && sorted[k] == shifted(at(cell), dx, row);
          c.neighbours[cell * stencil + row * 3 + static_cast<unsigned>(dx + 1)] = found ? number[k] : 0;
          k += found;
        }
      }
  });
}

}  // namespace pairsum

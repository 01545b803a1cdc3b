#pragma once
#include <algorithm>
#include <array>
#include <span>

#include <pairsum/core/team.hpp>
#include <pairsum/grid/cells.hpp>

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

/// The same where axes with a `period` close on themselves after so many cells, places of the fluid cells being set:
/// place(at) is what the cell with coordinates `at` is in `sorted`. Rows that do not go through a face ascend as in
/// connect_sorted(), but when a pointer jumps back to the first cells it starts again; cells of the others are looked
/// up one by one.
template <int D, class Place, class Make>
void connect_sorted_torus(const ivec<D>& period, std::span<const Place> sorted, std::span<const std::uint32_t> number,
                          cells<D>& c, const team& t, Make&& place) {
  constexpr unsigned stencil = cells<D>::stencil, rows = stencil / 3;
  constexpr std::size_t leap = 16;
  c.period = period;
  const auto search = [&](std::size_t from, const Place& p) {
    return static_cast<std::size_t>(
        std::lower_bound(sorted.begin() + static_cast<std::ptrdiff_t>(from), sorted.end(), p) - sorted.begin());
  };
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::array<std::size_t, rows> finger{};
    for (std::size_t cell = begin + 1; cell <= end; ++cell)
      for (unsigned row = 0; row < rows; ++row) {
        ivec<D> at = c.place[cell];
        for (unsigned d = 1, code = row; d < D; ++d, code /= 3)
          at[d] = turned(at[d] + static_cast<std::int64_t>(code % 3) - 1, period[d]);
        const std::int64_t x = at[0];
        std::size_t k = finger[row];
        for (int dx = -1; dx <= 1; ++dx) {
          at[0] = turned(x + dx, period[0]);
          const Place wanted = place(at);
          const bool ahead = k == 0 || sorted[k - 1] < wanted;
          if (!ahead || (k + leap < sorted.size() && sorted[k + leap] < wanted)) k = search(ahead ? k : 0, wanted);
          while (k < sorted.size() && sorted[k] < wanted) ++k;
          if (dx == -1) finger[row] = k;
          const bool found = k < sorted.size() && sorted[k] == wanted;
          c.neighbours[cell * stencil + row * 3 + static_cast<unsigned>(dx + 1)] = found ? number[k] : 0;
        }
      }
  });
}

}  // namespace pairsum

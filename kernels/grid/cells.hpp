#pragma once
#include <cstddef>
#include <cstdint>

#include <pairsum/core/column.hpp>
#include <pairsum/core/vec.hpp>
#include <pairsum/pattern/pattern.hpp>

namespace pairsum {

/// A contiguous range of particle indices.
struct index_range {
  std::uint32_t begin, end;  // uninitialised: a sum makes room for many in each unit
  std::uint32_t size() const { return end - begin; }
  bool empty() const { return begin == end; }
};

/// Coordinate a, from -1 to `period`, of an axis that closes on itself after so many cells; a where it does not (0).
constexpr std::int64_t turned(std::int64_t a, std::int64_t period) {
  return period == 0 ? a : a < 0 ? a + period : a < period ? a : a - period;
}

/// The particles of one cell, in the sorted particle set.
struct cell_range {
  index_range fluid{0, 0}, boundary{0, 0};
};

/// A grid as plain data for the backends, the same for every grid: only non-empty cells exist.
///
/// Cell 0 is the empty cell that stands for every cell without particles. Cells 1..fluid_cells hold fluid (and perhaps
/// boundary), the remaining ones boundary alone: they never open a loop, and so cost nothing.
template <int D>
struct cells {
  static constexpr unsigned stencil = pattern::stencil_cells<D>;

  column<cell_range> range;          ///< index: cell
  column<std::uint32_t> neighbours;  ///< cell of the neighbour at code n of fluid cell c: [c * 3^D + n]
  column<std::uint8_t> colour;       ///< parity of the fluid cell's coordinates, one bit per component
  column<ivec<D>> place;             ///< coordinates of the fluid cell, not negative; folded ones on a torus
  ivec<D> period{};               ///< cells of a grid that closes on itself, per component, even or 3; 0: it does not
  vec<D, double> low, per_metre;  ///< a cell's coordinates are floor((x - low) per_metre), in the working precision
  std::uint64_t revision = 0;     ///< changes whenever cells or their neighbours change
  std::size_t fluid_cells = 0;
  std::size_t total = 0;  ///< cells of the grid, empty ones included where it has them

  std::size_t nonempty() const { return range.size() - 1; }
  const std::uint32_t* neighbours_of(std::size_t c) const { return neighbours.data() + c * stencil; }
  /// Makes room for what a grid says of the fluid cells.
  void resize_fluid() {
    neighbours.resize((fluid_cells + 1) * stencil);
    colour.resize(fluid_cells + 1);
    place.resize(fluid_cells + 1);
  }
  void set_place(std::size_t c, const ivec<D>& at) {
    place[c] = at;
    unsigned parity = 0;
    for (unsigned d = 0; d < D; ++d) parity |= static_cast<unsigned>(at[d] & 1) << d;
    colour[c] = static_cast<std::uint8_t>(parity);
  }
  std::uint32_t neighbour(std::size_t c, unsigned code) const { return neighbours[c * stencil + code]; }
};

}  // namespace pairsum

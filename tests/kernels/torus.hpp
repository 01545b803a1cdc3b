#pragma once
#include <vector>

#include <pairsum/grid/cells.hpp>

namespace pairsum::test_kit {

/// Fluid cells of a grid with `period` cells per axis that closes on itself (period 0: an open one of `extent`), each
/// there if has_fluid(place); with their neighbour table, as a grid makes it.
template <int D, class HasFluid>
cells<D> make_cells(std::int64_t period, std::int64_t extent, HasFluid&& has_fluid) {
  const std::int64_t side = period > 0 ? period : extent;
  std::size_t all = 1;
  for (int d = 0; d < D; ++d) all *= static_cast<std::size_t>(side);
  const auto place_of = [&](std::size_t number) {
    ivec<D> at;
    for (int d = 0; d < D; ++d, number /= static_cast<std::size_t>(side))
      at[d] = static_cast<std::int64_t>(number % static_cast<std::size_t>(side));
    return at;
  };
  cells<D> c;
  std::vector<std::uint32_t> cell_at(all, 0);
  std::vector<ivec<D>> places(1);
  for (std::size_t n = 0; n < all; ++n) {
    if (!has_fluid(place_of(n))) continue;
    cell_at[n] = static_cast<std::uint32_t>(places.size());
    places.push_back(place_of(n));
  }
  c.fluid_cells = places.size() - 1;
  c.period.fill(period);
  c.resize_fluid();
  c.range.resize(places.size());
  for (std::uint32_t cell = 1; cell <= c.fluid_cells; ++cell) {
    c.set_place(cell, places[cell]);
    c.range[cell] = {cell - 1, cell, 0, 0};
    for (unsigned code = 0; code < cells<D>::stencil; ++code) {
      const auto step = pattern::neighbour_offset<D>(code);
      std::size_t number = 0;
      bool outside = false;
      for (int d = D - 1; d >= 0; --d) {
        std::int64_t at = places[cell][d] + step[d];
        if (period > 0) at = (at + period) % period;
        outside = outside || at < 0 || at >= side;
        number = number * static_cast<std::size_t>(side) + static_cast<std::size_t>(outside ? 0 : at);
      }
      c.neighbours[cell * cells<D>::stencil + code] = outside ? 0 : cell_at[number];
    }
  }
  return c;
}

}  // namespace pairsum::test_kit

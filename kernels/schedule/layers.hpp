#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include <pairsum/grid/cells.hpp>

namespace pairsum {

/// The fluid cells [begin, end) that have a coordinate along the last axis in common. That axis is the slowest in every
/// grid, so they follow each other; in 1D they are one cell.
///
/// A half stencil goes from a layer to itself and to the next one, never back: the codes above the middle are those
/// whose last step is +1, or 0 with the rest above the middle. So a sweep of layers [a, b) writes to layers a..b.
struct cell_layer {
  std::int64_t at;
  std::uint32_t begin, end;
};

/// The number of layers around a grid that closes on itself along the last axis; 0: it does not.
template <int D>
std::int64_t layers_around(const cells<D>& c) {
  return c.period[D - 1];
}

/// The layer that the half stencil goes to from layer `at`.
constexpr std::int64_t layer_after(std::int64_t at, std::int64_t around) { return at + 1 == around ? 0 : at + 1; }

/// The layers that hold fluid, ascending.
template <int D>
void find_layers(const cells<D>& c, std::vector<cell_layer>& layers) {
  layers.clear();
  const auto at = [&](std::size_t cell) { return static_cast<std::int64_t>(c.place[cell][D - 1]); };
  const std::size_t last = c.fluid_cells + 1;
  for (std::size_t begin = 1, end = 1; begin < last; begin = end) {
    const std::int64_t own = at(begin);
    std::size_t step = 1;  // in strides that double: a layer is one cell or ten thousand
    while (begin + step < last && at(begin + step) == own) step *= 2;
    std::size_t low = begin + step / 2, high = std::min(begin + step, last);
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (at(middle) == own ? low : high) = middle;
    }
    end = high;
    layers.push_back({own, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
  }
}

}  // namespace pairsum

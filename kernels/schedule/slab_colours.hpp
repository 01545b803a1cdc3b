#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <pairsum/schedule/block_cut.hpp>
#include <pairsum/schedule/layers.hpp>

namespace pairsum {

/// Slabs of at least `thickness` (from 2) layers by coordinate alone, whichever layers hold fluid, so that slabs of
/// equal parity never write to one layer: slab [a, b) writes to a..b, and the next but one begins at b + 2 or later. On
/// a grid of n layers that closes on itself their number is even, else the first and the last would be of one colour; 3
/// layers are one slab.
class slab_colours {
 public:
  static constexpr unsigned colours = 2;

  /// `around`: see layers_around(); even, 3, or 0.
  slab_colours(std::int64_t thickness, std::int64_t around)
      : cut_(around > 0 ? std::min(thickness, around / 2) : thickness, around) {}

  std::int64_t slab_of(std::int64_t layer) const { return cut_.block_of(layer); }
  static unsigned colour_of(std::int64_t slab) { return static_cast<unsigned>(slab % colours); }

 private:
  block_cut cut_;
};

/// How thick slabs are to be: 2 layers, or, where those are few particles' (1D, 2D), a power of two more, as long as
/// 128 slabs are left. It depends on nothing that differs between grids which fold nothing.
inline std::int64_t slab_thickness(std::size_t particles, std::size_t layers) {
  constexpr std::size_t enough_particles = 2048, enough_slabs = 128;
  std::size_t thickness = 2;
  while (layers / (2 * thickness) >= enough_slabs && particles / layers * thickness < enough_particles) thickness *= 2;
  return static_cast<std::int64_t>(thickness);
}

/// The fluid cells [begin, end) of a slab.
struct slab_cells {
  std::uint32_t begin, end;
};

/// The slabs that hold fluid, by colour.
inline std::array<std::vector<slab_cells>, slab_colours::colours> coloured_slabs(const std::vector<cell_layer>& layers,
                                                                                 const slab_colours& cut) {
  std::array<std::vector<slab_cells>, slab_colours::colours> slabs;
  std::int64_t last = -1;
  for (const cell_layer& layer : layers) {
    const std::int64_t slab = cut.slab_of(layer.at);
    auto& list = slabs[slab_colours::colour_of(slab)];
    if (slab == last)
      list.back().end = layer.end;
    else
      list.push_back({layer.begin, layer.end});
    last = slab;
  }
  return slabs;
}

}  // namespace pairsum

#pragma once
#include <cstdint>
#include <vector>

#include <pairsum/schedule/layers.hpp>

namespace pairsum::test_kit {

/// Layers with fluid where a bit of the mask is set, one cell each.
inline std::vector<cell_layer> layers_at(std::uint32_t mask) {
  std::vector<cell_layer> layers;
  for (std::uint32_t at = 0, cell = 1; at < 32; ++at)
    if (mask >> at & 1) layers.push_back({at, cell, cell + 1}), ++cell;
  return layers;
}

}  // namespace pairsum::test_kit

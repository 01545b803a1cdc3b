#include "sum/block_choice.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace pairsum {
namespace {

constexpr std::array widths{16, 12, 8, 6, 4, 3, 2};

/// Where the cells are along the last `axes` axes, each place once.
template <int D>
std::vector<ivec<D>> columns_of(const cells<D>& c, int axes) {
  std::vector<ivec<D>> all;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    ivec<D> at = c.place[cell];
    for (int d = 0; d < D - axes; ++d) at[d] = 0;
    if (all.empty() || at != all.back()) all.push_back(at);
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

template <class V>
std::size_t blocks_of(const std::vector<V>& columns, int width) {
  std::vector<V> all;
  for (V at : columns) {
    for (auto& a : at) a /= width;
    if (all.empty() || at != all.back()) all.push_back(at);
  }
  std::ranges::sort(all);
  return static_cast<std::size_t>(std::unique(all.begin(), all.end()) - all.begin());
}

/// Of a block in the cache: all of a brick, and of what is left whole along the first axis the cells in use.
std::size_t cells_in_use(int dim, int axes, int width) {
  std::size_t n = axes < dim ? 4 : 1;
  for (int d = 0; d < axes; ++d) n *= static_cast<std::size_t>(width) + 2;
  return n;
}

}  // namespace

block_limits limits_of(std::size_t cache_bytes, std::size_t bytes_per_cell, std::size_t cores) {
  constexpr std::size_t usual_cache = std::size_t{1} << 20, usual_cores = 2, blocks_per_core = 6;
  return {(cache_bytes > 0 ? cache_bytes : usual_cache) / 2 / bytes_per_cell,
          blocks_per_core * (cores > 0 ? cores : usual_cores)};
}

template <int D>
block_shape choose_block(const cells<D>& c, const block_limits& limits) {
  for (int axes = std::max(1, D - 1); axes <= D; ++axes) {
    const auto columns = columns_of(c, axes);
    for (const int width : widths)
      if (c.period % (2 * width) == 0 && cells_in_use(D, axes, width) <= limits.cells &&
          blocks_of(columns, width) >= limits.blocks << axes)
        return {axes, width};
  }
  return {D, widths.back()};
}

template block_shape choose_block(const cells<1>&, const block_limits&);
template block_shape choose_block(const cells<2>&, const block_limits&);
template block_shape choose_block(const cells<3>&, const block_limits&);

}  // namespace pairsum

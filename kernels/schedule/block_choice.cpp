#include <pairsum/schedule/block_choice.hpp>

#include <algorithm>
#include <array>
#include <thread>
#include <utility>
#include <vector>

#include <pairsum/core/places.hpp>
#include <pairsum/core/value.hpp>
#include <pairsum/schedule/block_cut.hpp>

namespace pairsum {
namespace {

constexpr std::array widths{16, 8, 4, 2};

/// Sorted, each once.
template <class V>
std::vector<V> distinct(std::vector<V> all) {
  all.erase(std::unique(all.begin(), all.end()), all.end());  // there are runs, and sorting what is left costs less
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Where the cells are along the last `axes` axes, each place once.
template <int D>
std::vector<ivec<D>> places_of(const cells<D>& c, int axes) {
  std::vector<ivec<D>> all;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    ivec<D> at = c.place[cell];
    for (int d = 0; d < D - axes; ++d) at[d] = 0;
    if (all.empty() || at != all.back()) all.push_back(at);
  }
  return distinct(std::move(all));
}

template <int D>
std::size_t blocks_of(std::vector<ivec<D>> places, int width, const cells<D>& c) {
  for (ivec<D>& at : places)
    for (int d = 0; d < D; ++d) at[d] = block_cut(width, c.period[d]).block_of(at[d]);
  return distinct(std::move(places)).size();
}

template <int D>
bool goes_round(const cells<D>& c, int axes, int width) {
  bool fits = true;
  for (int d = D - axes; d < D; ++d) fits = fits && block_cut(width, c.period[d]).fits();
  return fits;
}

/// What a sweep has in use at a time: a brick with a rim; of a pencil, by rule of thumb, 4 cells of its length (all of
/// it returns row after row, but is prefetched).
std::size_t cells_in_use(int dim, int axes, int width) {
  return (axes < dim ? 4 : 1) * power(static_cast<std::size_t>(width) + 2, axes);
}

}  // namespace

block_limits limits_of(std::size_t cache_bytes, std::size_t bytes_per_cell, std::size_t cores) {
  constexpr std::size_t usual_cache = std::size_t{1} << 20, blocks_per_core = 6;
  const std::size_t threads = cores > 0 ? cores : std::max(1u, std::thread::hardware_concurrency());
  return {(cache_bytes > 0 ? cache_bytes : usual_cache) / 2 / bytes_per_cell, blocks_per_core * threads};
}

template <int D>
block_shape choose_block(const cells<D>& c, const block_limits& limits) {
  for (int axes = std::max(1, D - 1); axes <= D; ++axes) {
    const std::size_t enough = limits.blocks << axes;
    std::vector<ivec<D>> places;
    for (const int width : widths) {
      if (!goes_round(c, axes, width) || cells_in_use(D, axes, width) > limits.cells) continue;
      if (axes == D && c.fluid_cells / power(static_cast<std::size_t>(width), D) >= enough)
        return {axes, width};  // even full, so without counting
      if (places.empty()) places = places_of(c, axes);
      if (blocks_of<D>(places, width, c) >= enough) return {axes, width};
    }
  }
  return {D, widths.back()};
}

#define PAIRSUM_CHOICES(D) template block_shape choose_block(const cells<D>&, const block_limits&);
PAIRSUM_EACH_D(PAIRSUM_CHOICES)

}  // namespace pairsum

#pragma once
#include <cstddef>

#include <pairsum/core/places.hpp>
#include <pairsum/grid/cells.hpp>
#include <pairsum/schedule/block_shape.hpp>

namespace pairsum {

/// Limits for chosen blocks.
struct block_limits {
  std::size_t cells = 0;   ///< of a block and around it that are in use at a time, at most
  std::size_t blocks = 0;  ///< of a colour, at least, on average
};

/// @param cache_bytes    of a core; 0: 1 MiB
/// @param bytes_per_cell what a sum touches of a cell; half the cache is for that
/// @param cores          6 blocks for each, so that all finish a pass at about the same time; 0: those of the machine
block_limits limits_of(std::size_t cache_bytes, std::size_t bytes_per_cell, std::size_t cores);

/// The shape for these cells: the widest pencils (in 2D slabs) that keep to the limits, or else the widest bricks, or
/// bricks of 2. Widths are powers of two, so that they fit every hashed grid and all grids have the same blocks.
///
/// Pencils come first because their rows are whole: a million particles on one thread take, relative to brick:4,
///
///     slab:2 0.68    pencil:2 0.75    pencil:8  0.67    brick:8  0.79
///     slab:4 0.68    pencil:4 0.69    pencil:16 0.66    brick:16 0.74
///
/// and slabs are too few for many threads.
template <int D>
block_shape choose_block(const cells<D>& c, const block_limits& limits);

#define PAIRSUM_CHOICES(D) extern template block_shape choose_block(const cells<D>&, const block_limits&);
PAIRSUM_EACH_D(PAIRSUM_CHOICES)
#undef PAIRSUM_CHOICES

}  // namespace pairsum

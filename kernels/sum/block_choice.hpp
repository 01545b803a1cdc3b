#pragma once
#include <cstddef>

#include "grid/cells.hpp"
#include "sum/block_shape.hpp"

namespace pairsum {

/// What blocks that are chosen have to keep to.
struct block_limits {
  std::size_t cells = 0;   ///< at most as many in the cache, with those around them
  std::size_t blocks = 0;  ///< of a colour, at least, on average
};

/// @param cache_bytes    of a core; 0: 1 MiB
/// @param bytes_per_cell what a sum touches of a cell; half the cache is for that
/// @param cores          of the machine, 6 blocks for each, so that a pass ends nearly together on all; 0: 2
block_limits limits_of(std::size_t cache_bytes, std::size_t bytes_per_cell, std::size_t cores);

/// The shape for these cells: the widest pencils (in 2D slabs), or bricks where those are too few. Rows along the first
/// axis are left whole as long as that is possible: a particle's row is then loaded
///
///     ((w+2)/w)^2 times by pencils,    ((w+2)/w)^3 times by bricks
///
/// of w cells, which is what a sum over more particles than the cache holds waits for. Goes round a torus if the cells
/// are one.
template <int D>
block_shape choose_block(const cells<D>& c, const block_limits& limits);

extern template block_shape choose_block(const cells<1>&, const block_limits&);
extern template block_shape choose_block(const cells<2>&, const block_limits&);
extern template block_shape choose_block(const cells<3>&, const block_limits&);

}  // namespace pairsum

#pragma once
#include <cstddef>
#include <string>

namespace pairsum {

/// How a grid is cut into blocks of cells: along one, two or three of its axes, the slowest first, every `width` cells.
struct block_shape {
  int axes = 3;
  int width = 2;
  bool adapts = false;  ///< narrower where it does not fit
  bool operator==(const block_shape&) const = default;

  /// slab:N (one axis), pencil:N (two) or brick:N (three), N from 2 to 4096 cells wide; axes that the dimension lacks
  /// do not count. Throws pairsum::error.
  static block_shape parse(const std::string& word);
  /// The widest bricks whose cells, with those around them, take half the cache.
  /// @param cache_bytes    of a core; 0: 1 MiB
  /// @param bytes_per_cell what a sum touches of a cell
  static block_shape fitting(int dim, std::size_t cache_bytes, std::size_t bytes_per_cell);
};

/// Throws pairsum::error unless the word is `auto` or a shape.
void check_block(const std::string& word);

}  // namespace pairsum

#pragma once
#include <string>

namespace pairsum {

/// In which order a thread visits the cells of a block.
enum class cell_order {
  rows,     ///< as the grid has them: row after row along the first axis
  bundles,  ///< two by two rows at a time: what a cell shares with three of its neighbours is still in the cache
  morton,   ///< along the Z-order curve
};

/// How a grid is cut into blocks of cells: along one, two or three of its axes, the slowest first, every `width` cells.
struct block_shape {
  int axes = 3;
  int width = 2;
  cell_order order = cell_order::rows;
  bool operator==(const block_shape&) const = default;

  /// slab:N (one axis), pencil:N (two) or brick:N (three), N from 2 to 4096 cells wide; axes that the dimension lacks
  /// do not count; then, if not rows, the order: slab:N:bundles or slab:N:morton. Throws pairsum::error.
  static block_shape parse(const std::string& word);
  /// The word that parse() takes.
  std::string word() const;
};

/// Throws pairsum::error unless the word is `auto` or a shape.
void check_block(const std::string& word);

}  // namespace pairsum

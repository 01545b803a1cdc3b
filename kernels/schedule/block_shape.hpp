#pragma once
#include <string>

namespace pairsum {

/// How a grid is cut into blocks of cells: along one, two or three of its axes, the slowest first, every `width` cells.
struct block_shape {
  int axes = 3;
  int width = 2;
  bool operator==(const block_shape&) const = default;

  /// slab:N (one axis), pencil:N (two) or brick:N (three), N from 2 to 4096 cells wide; axes that the dimension lacks
  /// do not count. Throws pairsum::error.
  static block_shape parse(const std::string& word);
  /// The word that parse() takes.
  std::string word() const;
};

/// Throws pairsum::error unless the word is `auto` or a shape.
void check_block(const std::string& word);

}  // namespace pairsum

#pragma once
#include <map>
#include <string>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// One side of a comparison of backends: a backend, and the words of those levels in which the sides may differ.
struct compared_side {
  std::string backend;
  std::map<std::string, std::string> levels;  ///< level -> word
  bool operator==(const compared_side&) const = default;
};

/// Reads "tiles_omp precision=mixed grid=compact_grid". Throws pairsum::error for a word that says nothing of a level.
compared_side parse_side(const std::string& text);

/// Is a point of this side? M of a grid that takes none is "none".
bool is_of(const point& p, const compared_side& side);

/// q with p's words in those levels that a side names: M too where one names the grid.
point without_differences(point q, const point& p, const compared_side& a, const compared_side& b);

}  // namespace pairsum::harness

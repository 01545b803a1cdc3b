#include "harness/rows/point_words.hpp"

namespace pairsum::harness {

std::string cells_word(const point& p) {
  if (p.M == 0) return p.grid;
  return (p.grid == "hashed_grid" ? "" : p.grid + " ") + "M=" + std::to_string(p.M);
}

std::string place_words(const point& p) {
  const bool shaped = p.block != "none" && p.block != "auto";
  return p.backend + " " + cells_word(p) + (shaped ? " " + p.block : "") + " threads=" + std::to_string(p.threads) +
         (p.ranks > 1 ? " ranks=" + std::to_string(p.ranks) + " " + p.cut : "");
}

}  // namespace pairsum::harness

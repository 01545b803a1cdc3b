#include "harness/rows/point_words.hpp"

namespace pairsum::harness {

std::string m_word(int M) { return M > 0 ? std::to_string(M) : "-"; }

std::string cells_word(const point& p) {
  if (p.M == 0) return p.grid;
  return (p.grid == "hashed_grid" ? "" : p.grid + " ") + "M=" + std::to_string(p.M);
}

std::string place_words(const point& p) {
  const bool shaped = p.block != "none" && p.block != "auto";
  return p.backend + " " + cells_word(p) + (shaped ? " " + p.block : "") + " threads=" + std::to_string(p.threads);
}

std::string choice_words(const point& p, const std::string& name) {
  std::string text = name;
  if (p.grid != "hashed_grid" || p.M == 0) text += " on " + p.grid;
  if (p.M > 0) text += " with M = " + std::to_string(p.M);
  return text + " and " + std::to_string(p.threads) + (p.threads == 1 ? " thread" : " threads");
}

}  // namespace pairsum::harness

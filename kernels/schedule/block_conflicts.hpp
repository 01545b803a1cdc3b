#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <pairsum/schedule/cell_blocks.hpp>

namespace pairsum {

/// Two blocks, the lower number first.
using block_pair = std::pair<std::uint32_t, std::uint32_t>;

/// The pairs of blocks (all of one colour, see cell_blocks) that write to a common cell, ascending. A block writes to
/// its cells and to their forward neighbours; so a cell is written to by its own block and by those of its backward
/// neighbours, and all of these are in conflict with each other.
template <int D>
std::vector<block_pair> conflicts_of(const cells<D>& c, const cell_blocks<D>& blocks) {
  std::vector<std::uint32_t> block_of(c.fluid_cells + 1);
  for (std::size_t b = 0; b < blocks.size(0); ++b)
    for (const std::uint32_t cell : blocks(0, b)) block_of[cell] = static_cast<std::uint32_t>(b);
  std::vector<block_pair> pairs;
  std::vector<std::uint32_t> writers, before;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    writers.assign(1, block_of[cell]);
    for (unsigned n = 0; n < pattern::stencil_centre<D>; ++n) {
      const std::uint32_t other = c.neighbour(cell, n);
      if (other == 0 || other > c.fluid_cells) continue;  // nobody's
      if (std::ranges::find(writers, block_of[other]) == writers.end()) writers.push_back(block_of[other]);
    }
    if (writers.size() == 1 || writers == before) continue;  // inside a block, or as in the cell before
    for (std::size_t a = 0; a < writers.size(); ++a)
      for (std::size_t b = a + 1; b < writers.size(); ++b) pairs.push_back(std::minmax(writers[a], writers[b]));
    before = writers;
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// A colour for each of `n` blocks so that no conflict is within one: block after block the first that is free. Where
/// the blocks fill a lattice these are its 2^axes parities.
inline std::vector<unsigned> colours_for(std::size_t n, const std::vector<block_pair>& conflicts) {
  std::vector<unsigned> colour(n, 0);
  std::vector<block_pair> lower;  // by the higher number
  lower.reserve(conflicts.size());
  for (const auto& [a, b] : conflicts) lower.emplace_back(b, a);
  std::ranges::sort(lower);
  std::vector<bool> taken;
  for (auto at = lower.begin(); at != lower.end();) {
    const std::uint32_t block = at->first;
    taken.assign(taken.size(), false);
    for (; at != lower.end() && at->first == block; ++at) {
      taken.resize(std::max<std::size_t>(taken.size(), colour[at->second] + 1), false);
      taken[colour[at->second]] = true;
    }
    colour[block] = static_cast<unsigned>(std::ranges::find(taken, false) - taken.begin());
  }
  return colour;
}

}  // namespace pairsum

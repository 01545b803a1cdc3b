#pragma once
#include <array>
#include <vector>

#include <pairsum/core/places.hpp>
#include <pairsum/pattern/axis_colours.hpp>
#include <pairsum/schedule/block.hpp>

namespace pairsum {

/// The base blocks of half cells: 3^d half cells B + {0,1,2}^d each, coloured so that blocks of a colour share none:
/// bases are 3 apart along every axis, (2+1)^d colours, and more where a torus has a seam (pattern/axis_colours.hpp). A
/// block is named by the talk's block of whole cells that it lies in, and the part of its base cell where it begins.
template <int D>
class half_blocks {
 public:
  static constexpr unsigned parts = 1u << D;
  struct unit {
    const block<D>* cells;
    unsigned part;
  };

  /// Does nothing if the cells are those of the last call. The same lists in the same order for every team.
  void build(const cells<D>& c, const team& t);

  /// Colours that have blocks.
  unsigned colours() const { return static_cast<unsigned>(by_colour_.size()); }
  std::size_t size(unsigned colour) const { return by_colour_[colour].size(); }
  unit operator()(unsigned colour, std::size_t k) const {
    const std::uint32_t n = by_colour_[colour][k];
    return {&blocks_[n / parts], n % parts};
  }

 private:
  column<block<D>> blocks_;
  std::vector<column<std::uint32_t>> by_colour_;
  std::uint64_t revision_ = 0;
};

#define PAIRSUM_HALF_BLOCKS(D) extern template class half_blocks<D>;
PAIRSUM_EACH_D(PAIRSUM_HALF_BLOCKS)
#undef PAIRSUM_HALF_BLOCKS

}  // namespace pairsum

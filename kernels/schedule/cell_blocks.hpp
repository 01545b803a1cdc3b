#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <pairsum/core/places.hpp>
#include <pairsum/grid/cells.hpp>
#include <pairsum/schedule/block_choice.hpp>

namespace pairsum {

/// The cells with fluid, in blocks of 2^axes colours: the parities of a block's number along the cut axes. One thread
/// sums a block with a half stencil, cell by cell in the order of the grid. It touches its own cells and one more on
/// either side:
///
///     colour 0 |   1   |   0   |   1        a slab:4 of colour 0 writes to cells -1..4,
///     0 1 2 3  |4 5 6 7|8 9 ..  |           the next one of its colour to 7..12
///
/// Blocks of a colour are a whole block apart and at least 2 wide, so they share no cell. Which cells make a block,
/// their order in it, and the order of a colour's blocks do not depend on the team.
template <int D>
class cell_blocks {
 public:
  /// `one_pass`: for sums that write their own cells alone; all blocks have one colour then.
  void shape(const block_shape& s, bool one_pass = false) {
    shape_ = s;
    limits_.reset();
    one_pass_ = one_pass;
    place_.clear();
  }
  /// As choose_block() finds best for the cells.
  void shape(const block_limits& limits, bool one_pass = false) {
    shape(block_shape(), one_pass);
    limits_ = limits;
  }

  /// Does nothing, and returns false, if the cells are those of the last call. Throws pairsum::error if blocks of two
  /// colours do not fit on a grid that closes on itself; on one that they do not divide some are wider than asked for,
  /// and an axis of 3 cells is not cut (block_cut.hpp).
  bool build(const cells<D>& c);

  /// As built last: it fits the grid and the dimension.
  block_shape shape() const { return {std::min(shape_.axes, D), shape_.width}; }
  unsigned colours() const { return static_cast<unsigned>(begin_.size()); }
  /// Blocks of a colour.
  std::size_t size(unsigned colour) const { return begin_[colour].size() - 1; }
  std::span<const std::uint32_t> operator()(unsigned colour, std::size_t block) const {
    const auto& b = begin_[colour];
    return {order_.data() + b[block], b[block + 1] - b[block]};
  }

 private:
  struct block {
    unsigned colour;
    std::uint32_t cells, next;
  };

  void find_blocks(const cells<D>& c, int axes);

  block_shape shape_;
  std::optional<block_limits> limits_;
  bool one_pass_ = false;
  std::vector<std::vector<std::uint32_t>> begin_;  ///< by colour: where in order_ its blocks begin, and the end
  std::vector<block> blocks_;
  column<std::uint32_t> order_, block_of_;
  std::vector<ivec<D>> place_;  ///< of the cells as built last
  ivec<D> period_{};
};

#define PAIRSUM_CELL_BLOCKS(D) extern template class cell_blocks<D>;
PAIRSUM_EACH_D(PAIRSUM_CELL_BLOCKS)
#undef PAIRSUM_CELL_BLOCKS

}  // namespace pairsum

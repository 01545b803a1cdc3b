#pragma once
#include <cstdint>

namespace pairsum {

/// How blocks of `width` cells or more cut one axis of a grid. On a grid that closes on itself after `period` cells
/// fit around in two colours: an even number of blocks that are wide enough, with cells distributed evenly, so that
/// some are wider where the period is no multiple of 2 width. An axis of 3 cells, too short for two blocks of any
/// width, is not cut: one block goes round it.
///
///     period 10, width 2:   |0 1|2 3 4|5 6|7 8 9|  and 0 again
class block_cut {
 public:
  /// period 0: the grid does not close.
  block_cut(std::int64_t width, std::int64_t period)
      : width_(width), period_(period), blocks_(period < 4 ? 1 : period / (2 * width) * 2) {}

  /// Do blocks of two colours fit around?
  bool fits() const { return period_ == 0 || blocks_ > 0; }
  /// The block that a cell is in.
  std::int64_t block_of(std::int64_t cell) const {
    return period_ == 0 ? cell / width_ : ((cell + 1) * blocks_ - 1) / period_;
  }

 private:
  std::int64_t width_, period_, blocks_;
};

}  // namespace pairsum

#pragma once
#include <array>

#include "core/team.hpp"
#include "sum/problem.hpp"

namespace pairsum {

/// The particles once more, sorted by half cells: every cell is cut in two along each axis, part number p having bit d
/// set in the upper half along axis d. Half cells that follow each other along the first axis do so in memory, as long
/// as their cells do; so three in a row are one range of candidates.
template <int D, class R>
class half_cell_order {
 public:
  static constexpr unsigned parts = 1u << D;

  /// The same order for every team.
  void build(const positions<D, R>& x, const cells<D>& c, std::size_t count, const team& t);

  /// Positions in this order.
  positions<D, R> x() const {
    positions<D, R> sorted;
    sorted.omega = omega_;
    for (int d = 0; d < D; ++d) sorted.column[d] = x_[d].data();
    return sorted;
  }
  /// Which particle is number k.
  std::uint32_t operator[](std::size_t k) const { return order_[k]; }
  /// The numbers in a part of a cell.
  const cell_range& range(std::size_t cell, unsigned part) const { return range_[cell * parts + part]; }

  /// Asks memory for where the parts of cells are.
  template <class Cells>
  [[gnu::always_inline]] void fetch_ranges(const Cells& cells) const {
    for (const std::uint32_t cell : cells) {
      __builtin_prefetch(range_.data() + cell * parts);
      __builtin_prefetch(range_.data() + cell * parts + parts - 1);
    }
  }
  /// Asks memory for the positions that begin a range, and for which particles are there.
  [[gnu::always_inline]] void fetch(const cell_range& range) const {
    __builtin_prefetch(order_.data() + range.fluid_begin);
    for (const auto& column : x_) __builtin_prefetch(column.data() + range.fluid_begin);
  }

 private:
  template <class Begin, class End>
  void sort_run(const cells<D>& c, std::size_t first, std::size_t end, Begin begin_of, End end_of);

  column<std::uint32_t> order_;
  column<std::uint8_t> part_;  ///< by particle
  std::array<column<R>, D> x_;
  torus<D, R> omega_;
  column<cell_range> range_;
};

extern template class half_cell_order<1, double>;
extern template class half_cell_order<2, double>;
extern template class half_cell_order<3, double>;
extern template class half_cell_order<1, float>;
extern template class half_cell_order<2, float>;
extern template class half_cell_order<3, float>;

}  // namespace pairsum

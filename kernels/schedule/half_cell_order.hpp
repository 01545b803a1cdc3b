#pragma once
#include <array>

#include <pairsum/core/places.hpp>
#include <pairsum/core/team.hpp>
#include <pairsum/grid/cells.hpp>
#include <pairsum/sum/search_space.hpp>

namespace pairsum {

/// The particles once more, sorted by half cells: every cell is cut in two along each axis, part number p having bit d
/// set in the upper half along axis d. Half cells that follow each other along the first axis do so in memory, as long
/// as their cells do; so three in a row are one range of candidates.
template <int D, class R>
class half_cell_order {
 public:
  static constexpr unsigned parts = 1u << D;

  /// The same order for every team.
  void build(const search_space<D, R>& space, const cells<D>& c, std::size_t count, const team& t);

  /// `space` in this order.
  search_space<D, R> space(search_space<D, R> s) const {
    s.order = order_.data();
    for (int d = 0; d < D; ++d) {
      s.x.column[d] = x_[d].data();
      s.places.place[d] = place_[d].data();
    }
    return s;
  }
  /// The numbers in a part of a cell.
  const cell_range& range(std::size_t cell, unsigned part) const { return range_[cell * parts + part]; }

  /// Prefetches where the parts of cells are.
  template <class Cells>
  [[gnu::always_inline]] void fetch_ranges(const Cells& cells) const {
    for (const std::uint32_t cell : cells) {
      __builtin_prefetch(range_.data() + cell * parts);
      __builtin_prefetch(range_.data() + cell * parts + parts - 1);
    }
  }
  /// Prefetches the positions that begin a range, and which particles are there.
  [[gnu::always_inline]] void fetch(const cell_range& range) const {
    __builtin_prefetch(order_.data() + range.fluid.begin);
    for (const auto& column : x_) __builtin_prefetch(column.data() + range.fluid.begin);
  }

 private:
  void sort_run(const cells<D>& c, std::size_t first, std::size_t end, index_range cell_range::*kind);

  column<std::uint32_t> order_;
  column<std::uint8_t> part_;  ///< by particle
  std::array<column<R>, D> x_;
  std::array<column<std::int32_t>, D> place_;  ///< of vector units
  column<cell_range> range_;
};

#define PAIRSUM_ORDERS(D, R) extern template class half_cell_order<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_ORDERS)
#undef PAIRSUM_ORDERS

}  // namespace pairsum

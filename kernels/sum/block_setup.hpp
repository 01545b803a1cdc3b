#pragma once
#include "sum/cell_blocks.hpp"
#include "sum/setup.hpp"

namespace pairsum {

/// Shapes blocks as the setup says; for `auto` by what a sum touches of a cell. Throws pairsum::error for a word that
/// is no shape.
template <int D>
void shape_blocks(cell_blocks<D>& blocks, const setup& s, std::size_t bytes_per_cell, bool one_pass = false) {
  check_block(s.block);
  if (s.block == "auto")
    blocks.shape(limits_of(s.cache_bytes, bytes_per_cell, s.cores), one_pass);
  else
    blocks.shape(block_shape::parse(s.block), one_pass);
}

/// Bytes of what interaction I's columns hold for a cell's particles, at the talk's spacing of H/2.
template <class I>
constexpr std::size_t column_bytes_per_cell() {
  constexpr int columns = I::dim + field_count<particle_of<I>> + field_count<rates_of<I>>;
  return (std::size_t{1} << I::dim) * static_cast<std::size_t>(columns) * sizeof(typename I::real);
}

}  // namespace pairsum

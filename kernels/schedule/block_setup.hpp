#pragma once
#include <pairsum/schedule/cell_blocks.hpp>
#include <pairsum/sum/setup.hpp>

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

}  // namespace pairsum

#pragma once
#include <array>
#include <cstdint>

#include <pairsum/pattern/pattern.hpp>

/// The talk's pattern for cells of half the cutoff: two cells up to two apart have pairs, so a base block has 3^d cells
/// B + {0,1,2}^d, an offset's code being the sum of o_k 3^k, and two of them belong to this block (and to no other) if
/// the smaller of their components is 0 along every axis.
namespace pairsum::pattern {

/// Do offsets j and k have a component of 0 along every axis?
template <int D>
constexpr bool in_half_block(unsigned j, unsigned k) {
  for (int d = 0; d < D; ++d, j /= 3, k /= 3)
    if (j % 3 != 0 && k % 3 != 0) return false;
  return true;
}

/// By offset j: the offsets k of the block that j has pairs with, ascending.
template <int D>
struct half_block_lists {
  std::array<std::uint16_t, stencil_cells<D> + 1> begin{};
  std::array<std::uint16_t, stencil_cells<D>> later{};  ///< where those with k > j begin
  std::array<std::uint8_t, power_of_3(D) * power_of_3(D)> offset{};
};

template <int D>
constexpr half_block_lists<D> make_half_block_lists() {
  half_block_lists<D> lists;
  std::uint16_t n = 0;
  for (unsigned j = 0; j < stencil_cells<D>; ++j) {
    lists.begin[j] = n;
    for (unsigned k = 0; k < stencil_cells<D>; ++k) {
      if (k != j ? in_half_block<D>(j, k) : j == 0) lists.offset[n++] = static_cast<std::uint8_t>(k);
      if (k == j) lists.later[j] = n;
    }
  }
  lists.begin[stencil_cells<D>] = n;
  return lists;
}
template <int D>
inline constexpr half_block_lists<D> half_block = make_half_block_lists<D>();

/// (5^d - 1) / 2: pairs of cells of a block; each is in two lists, and the base cell itself in its own.
template <int D>
constexpr unsigned half_block_pairs() {
  return (half_block<D>.begin[stencil_cells<D>] - 1u) / 2;
}
static_assert(half_block_pairs<1>() == 2 && half_block_pairs<2>() == 12 && half_block_pairs<3>() == 62);

/// A half cell: a cell of a block of 2^d whole cells, and its part, bit d being set in the upper half along axis d.
struct half_cell {
  std::uint8_t cell, part;
};

/// By the part of its base cell where a block of 3^d half cells begins, and an offset in it: the half cell there.
template <int D>
constexpr auto make_half_block_places() {
  std::array<std::array<half_cell, stencil_cells<D>>, block_cells<D>> places{};
  for (unsigned begin = 0; begin < block_cells<D>; ++begin)
    for (unsigned o = 0; o < stencil_cells<D>; ++o) {
      unsigned cell = 0, part = 0;
      for (unsigned d = 0, code = o; d < D; ++d, code /= 3) {
        const unsigned at = (begin >> d & 1) + code % 3;  // half cells from the lower end of the base cell
        cell |= at / 2 << d;
        part |= at % 2 << d;
      }
      places[begin][o] = {static_cast<std::uint8_t>(cell), static_cast<std::uint8_t>(part)};
    }
  return places;
}
template <int D>
inline constexpr auto half_block_place = make_half_block_places<D>();

}  // namespace pairsum::pattern

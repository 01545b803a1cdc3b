#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

/// The talk's pattern for any dimension d, at compile time. An offset in {0,1}^d is written as a code: bit k is
/// component k.
namespace pairsum::pattern {

/// 2^d: cells of a base block, and passes.
template <int D>
inline constexpr unsigned block_cells = 1u << D;

constexpr std::size_t power_of_3(int d) { return d == 0 ? 1 : 3 * power_of_3(d - 1); }

/// a(d): calls to sumF1 and sumF2 per base cell (OEIS A007051), b(d): calls to sumF2 (A003462), t(d): loop tests with k
/// < j.
constexpr std::size_t a(int d) { return d == 0 ? 1 : 3 * a(d - 1) - 1; }
constexpr std::size_t b(int d) { return (power_of_3(d) - 1) / 2; }
constexpr std::size_t t(int d) { return ((std::size_t{1} << d) * ((std::size_t{1} << d) - 1)) / 2; }

/// A pair of cells of the block: offsets j and k with k < j and no common component (j & k == 0).
struct code_pair {
  unsigned j, k;
};

/// How often the double loop of the talk tests "j*k == 0" when it visits k < j only.
template <int D>
constexpr std::size_t count_tests() {
  std::size_t n = 0;
  for (unsigned j = 0; j < block_cells<D>; ++j)
    for (unsigned k = 0; k < j; ++k) ++n;
  return n;
}

template <int D>
constexpr auto make_pairs() {
  std::array<code_pair, b(D)> pairs{};
  std::size_t n = 0;
  for (unsigned j = 0; j < block_cells<D>; ++j)
    for (unsigned k = 0; k < j; ++k)
      if ((j & k) == 0) pairs.at(n++) = {j, k};
  if (n != b(D)) throw "the pattern has b(d) pairs";
  return pairs;
}

/// The block's sumF2 calls, in the order of the talk's loops.
template <int D>
inline constexpr auto block_pairs = make_pairs<D>();

/// Index of the neighbour at offset o in {-1,0,1}^d within a neighbour table: sum of (o_k + 1) 3^k.
template <int D>
constexpr unsigned neighbour_code(const std::array<int, D>& o) {
  unsigned code = 0;
  for (int k = D - 1; k >= 0; --k) code = 3 * code + static_cast<unsigned>(o[k] + 1);
  return code;
}

template <int D>
constexpr std::array<int, D> neighbour_offset(unsigned code) {
  std::array<int, D> o{};
  for (int k = 0; k < D; ++k, code /= 3) o[k] = static_cast<int>(code % 3) - 1;
  return o;
}

/// 3^d: the cell itself and its neighbours; the cell itself has the middle code, and codes above it form a half
/// stencil.
template <int D>
inline constexpr unsigned stencil_cells = static_cast<unsigned>(power_of_3(D));
template <int D>
inline constexpr unsigned stencil_centre = (stencil_cells<D> - 1) / 2;

/// Calls visit(code) for the neighbours one step ahead along the first axis (which codes count fastest): all 3^(d-1),
/// or those of the half stencil that codes above the middle form.
template <int D, bool half, class Visit>
[[gnu::always_inline]] constexpr void each_ahead(Visit&& visit) {
  for (unsigned code = half ? stencil_centre<D> + 1 : 2; code < stencil_cells<D>; code += 3) visit(code);
}

/// Neighbour code, seen from block cell `from`, of block cell `to` (both offsets in {0,1}^d).
template <int D>
constexpr unsigned step_code(unsigned from, unsigned to) {
  std::array<int, D> o{};
  for (int k = 0; k < D; ++k) o[k] = static_cast<int>(to >> k & 1u) - static_cast<int>(from >> k & 1u);
  return neighbour_code<D>(o);
}

namespace checks {
template <int D>
constexpr bool counts_hold() {
  return block_pairs<D>.size() == b(D) && a(D) == b(D) + 1 && count_tests<D>() == t(D);
}
static_assert(counts_hold<0>() && counts_hold<1>() && counts_hold<2>() && counts_hold<3>() && counts_hold<4>());
static_assert(a(0) == 1 && a(1) == 2 && a(2) == 5 && a(3) == 14 && a(4) == 41 && a(5) == 122 && a(6) == 365 &&
              a(7) == 1094);
static_assert(b(0) == 0 && b(1) == 1 && b(2) == 4 && b(3) == 13 && b(4) == 40 && b(5) == 121 && b(6) == 364 &&
              b(7) == 1093);
static_assert(t(0) == 0 && t(1) == 1 && t(2) == 6 && t(3) == 28 && t(4) == 120);
}  // namespace checks

}  // namespace pairsum::pattern

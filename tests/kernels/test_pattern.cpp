#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "pattern/pattern.hpp"

// The talk's pattern on a torus of even side, for any schedule: each pair of neighbouring cells
// belongs to one base block, and the blocks of one pass (bases of equal parity) share no cell.
namespace pairsum {
namespace {

static_assert(pattern::a(1) == 2 && pattern::a(2) == 5 && pattern::a(3) == 14 &&
              pattern::a(4) == 41);
static_assert(pattern::b(1) == 1 && pattern::b(2) == 4 && pattern::b(3) == 13 &&
              pattern::b(4) == 40);
static_assert(pattern::t(1) == 1 && pattern::t(2) == 6 && pattern::t(3) == 28 &&
              pattern::t(4) == 120);
static_assert(pattern::count_tests<3>() == 28 && pattern::count_tests<4>() == 120);
static_assert(pattern::block_pairs<3>.size() == 13 && pattern::block_pairs<4>.size() == 40);
static_assert(pattern::stencil_centre<2> == 4 && pattern::stencil_centre<3> == 13);
static_assert(pattern::neighbour_offset<3>(pattern::neighbour_code<3>({-1, 0, 1})) ==
              std::array<int, 3>{-1, 0, 1});
static_assert(pattern::step_code<2>(0, 3) == pattern::neighbour_code<2>({1, 1}) &&
              pattern::step_code<2>(2, 1) == pattern::neighbour_code<2>({1, -1}));

template <int D>
struct torus {
  int side;

  int cells() const {
    int n = 1;
    for (int d = 0; d < D; ++d) n *= side;
    return n;
  }
  std::array<int, D> coordinates(int cell) const {
    std::array<int, D> c;
    for (int d = 0; d < D; ++d, cell /= side) c[d] = cell % side;
    return c;
  }
  int cell(std::array<int, D> c) const {
    int n = 0;
    for (int d = D - 1; d >= 0; --d) n = n * side + (c[d] % side + side) % side;
    return n;
  }
  /// Cell at offset {0,1}^d, given as a code, from a base.
  int at(int base, unsigned code) const {
    auto c = coordinates(base);
    for (int d = 0; d < D; ++d) c[d] += static_cast<int>(code >> d & 1u);
    return cell(c);
  }
  unsigned parity(int base) const {
    const auto c = coordinates(base);
    unsigned o = 0;
    for (int d = 0; d < D; ++d) o |= static_cast<unsigned>(c[d] & 1) << d;
    return o;
  }
};

/// Does every unordered pair of neighbours, and every cell with itself, come up exactly once?
template <int D>
bool covers_each_pair_once(int side, unsigned pairs_used = pattern::b(D)) {
  const torus<D> t{side};
  std::map<std::pair<int, int>, int> visits;
  for (int base = 0; base < t.cells(); ++base) {
    ++visits[{base, base}];
    for (unsigned n = 0; n < pairs_used; ++n) {
      const auto [j, k] = pattern::block_pairs<D>[n];
      ++visits[std::minmax({t.at(base, j), t.at(base, k)})];
    }
  }
  std::set<std::pair<int, int>> expected;
  for (int cell = 0; cell < t.cells(); ++cell)
    for (unsigned n = 0; n < pattern::stencil_cells<D>; ++n) {
      auto c = t.coordinates(cell);
      const auto o = pattern::neighbour_offset<D>(n);
      for (int d = 0; d < D; ++d) c[d] += o[d];
      expected.insert(std::minmax({cell, t.cell(c)}));
    }
  return visits.size() == expected.size() && std::ranges::all_of(visits, [&](const auto& v) {
           return v.second == 1 && expected.contains(v.first);
         });
}

/// Do no two blocks of a pass share a cell?
template <int D>
bool passes_are_conflict_free(int side) {
  const torus<D> t{side};
  std::map<std::pair<unsigned, int>, int> owners;
  for (int base = 0; base < t.cells(); ++base)
    for (unsigned o = 0; o < pattern::block_cells<D>; ++o)
      ++owners[{t.parity(base), t.at(base, o)}];
  return std::ranges::all_of(owners, [](const auto& o) { return o.second == 1; });
}

template <class Dim>
struct pattern_test : testing::Test {};
template <int D>
using dim = std::integral_constant<int, D>;
using dims = testing::Types<dim<1>, dim<2>, dim<3>, dim<4>>;
TYPED_TEST_SUITE(pattern_test, dims);

TYPED_TEST(pattern_test, block_pairs_cover_each_pair_of_neighbours_once) {
  EXPECT_TRUE(covers_each_pair_once<TypeParam::value>(4));
  EXPECT_TRUE(covers_each_pair_once<TypeParam::value>(6));
}
TYPED_TEST(pattern_test, coverage_check_rejects) {
  EXPECT_FALSE(covers_each_pair_once<TypeParam::value>(2)) << "-1 and +1 are one cell";
  EXPECT_FALSE(covers_each_pair_once<TypeParam::value>(4, pattern::b(TypeParam::value) - 1));
}
TYPED_TEST(pattern_test, blocks_of_a_pass_share_no_cell) {
  EXPECT_TRUE(passes_are_conflict_free<TypeParam::value>(4));
  EXPECT_TRUE(passes_are_conflict_free<TypeParam::value>(8));
}
TYPED_TEST(pattern_test, conflict_check_rejects_an_odd_torus) {
  EXPECT_FALSE(passes_are_conflict_free<TypeParam::value>(5));
}

}  // namespace
}  // namespace pairsum

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <pairsum/pattern/pattern.hpp>
#include <pairsum/schedule/block.hpp>

// The talk's pattern on a torus of even side, for any schedule: each pair of neighbouring cells
// belongs to one base block, and the blocks of one pass (bases of equal parity) share no cell.
namespace pairsum {
namespace {

static_assert(pattern::a(1) == 2 && pattern::a(2) == 5 && pattern::a(3) == 14 && pattern::a(4) == 41);
static_assert(pattern::b(1) == 1 && pattern::b(2) == 4 && pattern::b(3) == 13 && pattern::b(4) == 40);
static_assert(pattern::t(1) == 1 && pattern::t(2) == 6 && pattern::t(3) == 28 && pattern::t(4) == 120);
static_assert(pattern::count_tests<3>() == 28 && pattern::count_tests<4>() == 120);
static_assert(pattern::block_pairs<3>.size() == 13 && pattern::block_pairs<4>.size() == 40);
static_assert(pattern::stencil_centre<2> == 4 && pattern::stencil_centre<3> == 13);
static_assert(pattern::neighbour_offset<3>(pattern::neighbour_code<3>({-1, 0, 1})) == std::array<int, 3>{-1, 0, 1});
static_assert(pattern::step_code<2>(0, 3) == pattern::neighbour_code<2>({1, 1}) &&
              pattern::step_code<2>(2, 1) == pattern::neighbour_code<2>({1, -1}));

template <int D>
struct torus_of_cells {
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
  const torus_of_cells<D> t{side};
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
  return visits.size() == expected.size() &&
         std::ranges::all_of(visits, [&](const auto& v) { return v.second == 1 && expected.contains(v.first); });
}

/// Do no two blocks of a pass share a cell?
template <int D>
bool passes_are_conflict_free(int side) {
  const torus_of_cells<D> t{side};
  std::map<std::pair<unsigned, int>, int> owners;
  for (int base = 0; base < t.cells(); ++base)
    for (unsigned o = 0; o < pattern::block_cells<D>; ++o) ++owners[{t.parity(base), t.at(base, o)}];
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
TYPED_TEST(pattern_test, ahead_are_all_that_are_one_step_ahead) {
  constexpr int D = TypeParam::value;
  std::vector<unsigned> all, half, expected, expected_half;
  pattern::each_ahead<D, false>([&](unsigned code) { all.push_back(code); });
  pattern::each_ahead<D, true>([&](unsigned code) { half.push_back(code); });
  for (unsigned code = 0; code < pattern::stencil_cells<D>; ++code) {
    if (pattern::neighbour_offset<D>(code)[0] != 1) continue;
    expected.push_back(code);
    if (code > pattern::stencil_centre<D>) expected_half.push_back(code);
  }
  EXPECT_EQ(all, expected);
  EXPECT_EQ(half, expected_half);
}

TYPED_TEST(pattern_test, blocks_of_a_pass_share_no_cell) {
  EXPECT_TRUE(passes_are_conflict_free<TypeParam::value>(4));
  EXPECT_TRUE(passes_are_conflict_free<TypeParam::value>(8));
}
TYPED_TEST(pattern_test, conflict_check_rejects_an_odd_torus) {
  EXPECT_FALSE(passes_are_conflict_free<TypeParam::value>(5));
}

/// A full torus as a grid would describe it: cell n of the torus is cell n + 1, with one fluid particle.
template <int D>
cells<D> full_cells(int side) {
  const torus_of_cells<D> t{side};
  const std::size_t n = static_cast<std::size_t>(t.cells());
  cells<D> c;
  c.range.resize(n + 1);
  c.neighbours.resize((n + 1) * cells<D>::stencil);
  c.colour.resize(n + 1);
  c.place.resize(n + 1);
  c.period.fill(side);
  c.fluid_cells = c.total = n;
  c.range[0] = {};
  c.colour[0] = 0;
  for (unsigned k = 0; k < cells<D>::stencil; ++k) c.neighbours[k] = 0;
  for (std::uint32_t cell = 1; cell <= n; ++cell) {
    c.range[cell] = {cell - 1, cell, 0, 0};
    c.colour[cell] = static_cast<std::uint8_t>(t.parity(static_cast<int>(cell) - 1));
    for (unsigned k = 0; k < cells<D>::stencil; ++k) {
      auto at = t.coordinates(static_cast<int>(cell) - 1);
      for (int d = 0; d < D; ++d) c.place[cell][d] = at[d];
      const auto o = pattern::neighbour_offset<D>(k);
      for (int d = 0; d < D; ++d) at[d] += o[d];
      c.neighbours[cell * cells<D>::stencil + k] = static_cast<std::uint32_t>(t.cell(at)) + 1;
    }
  }
  return c;
}

template <int D>
using block_lists = std::vector<std::vector<block<D>>>;

/// The lists of the library itself, one per colour.
template <int D>
block_lists<D> library_blocks(int side, const team& t = team()) {
  coloured_blocks<D> built;
  built.build(full_cells<D>(side), t);
  block_lists<D> lists;
  for (unsigned o = 0; o < built.colours(); ++o) lists.emplace_back(built[o].begin(), built[o].end());
  return lists;
}

/// What is wrong with these lists on a full torus, "" if nothing is.
template <int D>
std::string fault_of(const block_lists<D>& lists, int side) {
  const torus_of_cells<D> t{side};
  std::vector<int> bases(static_cast<std::size_t>(t.cells()), 0);
  std::map<std::pair<int, int>, int> visits;
  for (const auto& of_one_colour : lists) {
    std::set<std::uint32_t> taken;
    for (const block<D>& b : of_one_colour) {
      for (const std::uint32_t cell : b) {
        if (cell < 1 || cell > bases.size()) return "no such cell";
        if (!taken.insert(cell).second) return "two blocks of one colour share a cell";
      }
      ++bases[b[0] - 1];
      for (const auto& [j, k] : pattern::block_pairs<D>)
        ++visits[std::minmax(static_cast<int>(b[j]) - 1, static_cast<int>(b[k]) - 1)];
    }
  }
  for (const int n : bases)
    if (n != 1) return "a base cell is not listed once";
  std::set<std::pair<int, int>> neighbours;
  for (int cell = 0; cell < t.cells(); ++cell)
    for (unsigned n = 0; n < pattern::stencil_cells<D>; ++n) {
      auto c = t.coordinates(cell);
      const auto o = pattern::neighbour_offset<D>(n);
      for (int d = 0; d < D; ++d) c[d] += o[d];
      if (t.cell(c) != cell) neighbours.insert(std::minmax({cell, t.cell(c)}));
    }
  for (const auto& [pair, n] : visits)
    if (n != 1 || !neighbours.contains(pair)) return "a pair is visited twice, or is none";
  return visits.size() == neighbours.size() ? "" : "a pair is never visited";
}

template <class Dim>
struct library_blocks_test : testing::Test {};
using library_dims = testing::Types<dim<1>, dim<2>, dim<3>>;
TYPED_TEST_SUITE(library_blocks_test, library_dims);

TYPED_TEST(library_blocks_test, cover_each_pair_once_without_conflicts) {
  constexpr int D = TypeParam::value;
  for (const int side : {3, 4, 6}) {
    EXPECT_EQ(fault_of<D>(library_blocks<D>(side), side), "") << "side " << side;
    EXPECT_EQ(fault_of<D>(library_blocks<D>(side, team::omp(3)), side), "") << "side " << side;
  }
}
TYPED_TEST(library_blocks_test, check_rejects_merged_colours) {
  constexpr int D = TypeParam::value;
  for (const int side : {3, 4}) {
    const auto good = library_blocks<D>(side);
    EXPECT_EQ(good.size(), std::pow(side == 3 ? 3 : 2, D));
    for (std::size_t o = 1; o < good.size(); ++o) {
      auto merged = good;
      merged[0].insert(merged[0].end(), good[o].begin(), good[o].end());
      merged[o].clear();
      EXPECT_EQ(fault_of<D>(merged, side), "two blocks of one colour share a cell") << "colour " << o;
    }
  }
}
TYPED_TEST(library_blocks_test, check_rejects_lost_repeated_and_bent_blocks) {
  constexpr int D = TypeParam::value;
  const auto good = library_blocks<D>(4);
  auto lost = good;
  lost.back().pop_back();
  EXPECT_EQ(fault_of<D>(lost, 4), "a base cell is not listed once");
  auto repeated = good;
  repeated.push_back({good[0][0]});
  EXPECT_EQ(fault_of<D>(repeated, 4), "a base cell is not listed once");
  auto bent = good;
  std::swap(bent[0][0][1], bent[0][1][1]);
  EXPECT_NE(fault_of<D>(bent, 4), "");
}
TYPED_TEST(library_blocks_test, check_rejects_wrong_colours_of_the_cells) {
  constexpr int D = TypeParam::value;
  cells<D> c = full_cells<D>(4);
  c.colour[1] ^= 1;
  coloured_blocks<D> built;
  built.build(c, team());
  block_lists<D> lists;
  for (unsigned o = 0; o < built.colours(); ++o) lists.emplace_back(built[o].begin(), built[o].end());
  EXPECT_NE(fault_of<D>(lists, 4), "");
}

}  // namespace
}  // namespace pairsum

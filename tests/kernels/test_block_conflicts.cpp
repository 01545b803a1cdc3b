#include <pairsum/schedule/block_conflicts.hpp>

#include <gtest/gtest.h>

#include <set>

#include <pairsum/core/random.hpp>
#include "torus.hpp"

// Blocks as tasks: of two that write to a common cell one waits for the other, and nobody waits for nothing.
namespace pairsum {
namespace {

using namespace test_kit;

/// Conflicts by the definition: the cells that each block writes to, and whose sets meet.
template <int D>
std::vector<block_pair> by_definition(const cells<D>& c, const cell_blocks<D>& blocks) {
  std::vector<std::set<std::uint32_t>> written(blocks.size(0));
  for (std::size_t b = 0; b < blocks.size(0); ++b)
    for (const std::uint32_t cell : blocks(0, b)) {
      written[b].insert(cell);
      for (unsigned n = pattern::stencil_centre<D> + 1; n < cells<D>::stencil; ++n)
        written[b].insert(c.neighbour(cell, n));
      written[b].erase(0);
    }
  std::vector<block_pair> pairs;
  for (std::uint32_t a = 0; a < written.size(); ++a)
    for (std::uint32_t b = a + 1; b < written.size(); ++b)
      if (std::ranges::any_of(written[a], [&](std::uint32_t cell) { return written[b].contains(cell); }))
        pairs.emplace_back(a, b);
  return pairs;
}

template <int D>
void expect_conflicts(std::int64_t period, std::int64_t extent, int one_in) {
  const counter_random random(static_cast<std::uint64_t>(extent));
  std::uint64_t n = 0;
  const cells<D> c = make_cells<D>(period, extent, [&](const ivec<D>&) { return random.bits(n++) % one_in == 0; });
  for (const int axes : {1, 2, 3})
    for (const int width : {2, 3, 4}) {
      cell_blocks<D> blocks;
      blocks.shape(block_shape{axes, width}, true);
      blocks.build(c);
      SCOPED_TRACE(testing::Message() << D << "D, period " << period << ", " << blocks.shape().word());
      const auto conflicts = conflicts_of(c, blocks);
      ASSERT_EQ(conflicts, by_definition(c, blocks));
      const auto colour = colours_for(blocks.size(0), conflicts);
      for (const auto& [a, b] : conflicts) ASSERT_NE(colour[a], colour[b]);
      if (one_in == 1 && period == 0 && !colour.empty()) {
        EXPECT_EQ(std::ranges::max(colour), (1u << std::min(axes, D)) - 1) << "those of a lattice";
      }
    }
}

TEST(block_conflicts, are_the_pairs_that_write_to_a_common_cell) {
  for (const std::int64_t period : {0, 3, 4, 6, 10})
    for (const int one_in : {1, 2, 9}) {
      expect_conflicts<1>(period, 40, one_in);
      expect_conflicts<2>(period, 16, one_in);
      expect_conflicts<3>(period, 9, one_in);
    }
}

TEST(block_conflicts, no_cell_has_none) {
  const cells<2> c = make_cells<2>(4, 4, [](const ivec<2>&) { return false; });
  cell_blocks<2> blocks;
  blocks.shape(block_shape{2, 2}, true);
  EXPECT_TRUE(blocks.build(c));
  EXPECT_FALSE(blocks.build(c)) << "the same cells";
  EXPECT_TRUE(conflicts_of(c, blocks).empty());
  EXPECT_TRUE(colours_for(0, {}).empty());
}

TEST(block_conflicts, colours_are_the_first_that_are_free) {
  EXPECT_EQ(colours_for(5, {{0, 1}, {0, 2}, {1, 2}, {2, 4}}), (std::vector<unsigned>{0, 1, 2, 0, 0}));
}

}  // namespace
}  // namespace pairsum

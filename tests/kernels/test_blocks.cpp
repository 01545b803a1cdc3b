#include <gtest/gtest.h>

#include <set>

#include <pairsum/schedule/block.hpp>
#include "indexed_scene.hpp"
#include "unit_trace.hpp"

// The race test on real data, independent of any schedule: which particles each block may write,
// and which it writes.
namespace pairsum {
namespace {

using namespace test_kit;
using blocks = std::vector<block<3>>;

/// Fluid particles that two blocks of one pass may write.
std::size_t conflicts(const blocks& pass, const cells<3>& c, std::size_t fluid) {
  std::vector<int> writers(fluid, 0);
  for (const block<3>& b : pass)
    for (const std::uint32_t cell : b)
      for (auto i = c.range[cell].fluid.begin; i < c.range[cell].fluid.end; ++i) ++writers[i];
  return static_cast<std::size_t>(std::ranges::count_if(writers, [](int n) { return n > 1; }));
}

blocks pass_of(const coloured_blocks<3>& all, unsigned colour) { return {all[colour].begin(), all[colour].end()}; }

class blocks_test : public testing::TestWithParam<grid_choice> {
 protected:
  indexed_scene s{make_scene("dam_break", 0.03, "perturbed"), GetParam()};
  coloured_blocks<3> coloured;
  void SetUp() override { coloured.build(s.index.view(), team()); }
};
INSTANTIATE_TEST_SUITE_P(grid, blocks_test, testing::ValuesIn(every_grid({2, 3, 6})));

TEST_P(blocks_test, blocks_of_one_colour_write_different_particles) {
  std::size_t n = 0;
  for (unsigned o = 0; o < 8; ++o) {
    EXPECT_EQ(conflicts(pass_of(coloured, o), s.index.view(), s.index.fluid()), 0u) << "colour " << o;
    n += coloured[o].size();
  }
  EXPECT_GT(n, 8u);
}

TEST_P(blocks_test, merged_colours_are_detected) {
  for (unsigned o = 1; o < 8; ++o) {
    blocks merged = pass_of(coloured, 0);
    merged.insert(merged.end(), coloured[o].begin(), coloured[o].end());
    EXPECT_GT(conflicts(merged, s.index.view(), s.index.fluid()), 0u) << "colour " << o;
  }
}

TEST_P(blocks_test, every_base_block_with_fluid_is_listed_once) {
  std::map<std::array<int, 3>, std::size_t> fluid_cells;
  for (std::size_t i = 0; i < s.index.fluid(); ++i) ++fluid_cells[s.cell_of(i)];
  std::set<std::array<int, 3>> bases;
  const int mask = s.mask;
  for (const auto& [c, n] : fluid_cells)
    for (int o = 0; o < 8; ++o)
      bases.insert({(c[0] - (o & 1)) & mask, (c[1] - (o >> 1 & 1)) & mask, (c[2] - (o >> 2)) & mask});
  std::vector<std::size_t> per_colour(8, 0);
  for (const auto& b : bases) ++per_colour[(b[0] & 1) | (b[1] & 1) << 1 | (b[2] & 1) << 2];
  for (unsigned o = 0; o < 8; ++o) EXPECT_EQ(coloured[o].size(), per_colour[o]) << "colour " << o;
}

TEST_P(blocks_test, lists_are_the_same_for_every_team) {
  for (const int threads : {2, 3, 7}) {
    coloured_blocks<3> other;
    other.build(s.index.view(), team::omp(threads));
    for (unsigned o = 0; o < 8; ++o) EXPECT_EQ(pass_of(other, o), pass_of(coloured, o));
  }
}

/// Runs sum_block alone, with a reach that lets every candidate interact, and looks at what
/// changed.
TEST_P(blocks_test, sum_block_writes_its_own_cells_alone) {
  const counted_problem<3> counted(s.particles, s.index, s.world);
  const problem<3, double>& p = counted.p;
  std::size_t written = 0;
  for (unsigned o = 0; o < 8; ++o)
    for (std::size_t k = 0; k < coloured[o].size(); k += 5) {
      const block<3>& b = coloured[o][k];
      p.pairs->zero(p.u, 0, p.fluid_count);
      sum_block(p, b, p.to(0));
      std::vector<bool> may(s.index.fluid(), false);
      for (const std::uint32_t cell : b)
        for (auto i = s.index.view().range[cell].fluid.begin; i < s.index.view().range[cell].fluid.end; ++i)
          may[i] = true;
      for (std::size_t i = 0; i < s.index.fluid(); ++i) {
        const bool wrote = counted.neighbours(i) != 0;
        ASSERT_TRUE(may[i] || !wrote) << "block " << k << " of colour " << o << " wrote particle " << i;
        written += wrote;
      }
    }
  EXPECT_GT(written, s.index.fluid() / 2);
}

}  // namespace
}  // namespace pairsum

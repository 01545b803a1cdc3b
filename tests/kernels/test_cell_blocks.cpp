#include <gtest/gtest.h>

#include <set>

#include <pairsum/schedule/block_cut.hpp>
#include <pairsum/schedule/cell_blocks.hpp>
#include "indexed_scene.hpp"

// Blocks of cells: each cell once, and blocks of a colour write different particles, whatever the schedule.
namespace pairsum {
namespace {

using namespace test_kit;

struct shaped_grid {
  grid_choice grid;
  block_shape shape;
  bool periodic = false;
};
std::ostream& operator<<(std::ostream& o, const shaped_grid& s) {
  return o << s.grid << " " << s.shape.word() << (s.periodic ? " periodic" : "");
}

std::vector<shaped_grid> every_shape() {
  std::vector<shaped_grid> all;
  for (const grid_choice& grid : every_grid({2, 3, 6}))
    for (const int axes : {1, 2, 3})
      for (const int width : {2, 3, 4})
        if (grid.M == 0 || (1 << grid.M) % (2 * width) == 0) all.push_back({grid, {axes, width}});
  for (const grid_choice& grid : every_grid({2, 3}))  // a box of 10 cells, or 8 with an M
    for (const int axes : {1, 2, 3})
      for (const int width : {2, 3, 4, 5})
        if (2 * width <= (grid.M > 0 ? 1 << grid.M : 10)) all.push_back({grid, {axes, width}, true});
  return all;
}

class cell_blocks_test : public testing::TestWithParam<shaped_grid> {
 protected:
  indexed_scene s{GetParam().periodic ? make_scene("periodic_lattice", 0.049, "perturbed")
                                      : make_scene("dam_break", 0.03, "perturbed"),
                  GetParam().grid};
  const cells<3>& c = s.index.view();
  cell_blocks<3> blocks;
  void SetUp() override {
    blocks.shape(GetParam().shape);
    blocks.build(c);
  }

  /// The cells a block may write: its own and their forward neighbours.
  std::set<std::uint32_t> touched(unsigned colour, std::size_t block) const {
    std::set<std::uint32_t> all;
    for (const std::uint32_t cell : blocks(colour, block)) {
      all.insert(cell);
      for (unsigned n = pattern::stencil_centre<3> + 1; n < cells<3>::stencil; ++n) all.insert(c.neighbour(cell, n));
    }
    all.erase(0);
    return all;
  }
  /// Cells that two blocks of these colours may write.
  std::size_t conflicts(const std::vector<unsigned>& colours) const {
    std::vector<int> writers(c.range.size(), 0);
    for (const unsigned colour : colours)
      for (std::size_t b = 0; b < blocks.size(colour); ++b)
        for (const std::uint32_t cell : touched(colour, b)) ++writers[cell];
    return static_cast<std::size_t>(std::ranges::count_if(writers, [](int n) { return n > 1; }));
  }
};
INSTANTIATE_TEST_SUITE_P(shape, cell_blocks_test, testing::ValuesIn(every_shape()));

TEST_P(cell_blocks_test, every_cell_with_fluid_is_in_one_block) {
  std::vector<int> times(c.fluid_cells + 1, 0);
  ASSERT_EQ(blocks.colours(), 1u << GetParam().shape.axes);
  for (unsigned colour = 0; colour < blocks.colours(); ++colour)
    for (std::size_t b = 0; b < blocks.size(colour); ++b) {
      EXPECT_FALSE(blocks(colour, b).empty());
      for (const std::uint32_t cell : blocks(colour, b)) ++times.at(cell);
    }
  EXPECT_EQ(times[0], 0);
  EXPECT_EQ(std::ranges::count(times, 1), static_cast<std::ptrdiff_t>(c.fluid_cells));
}

TEST_P(cell_blocks_test, blocks_of_a_colour_write_different_cells) {
  for (unsigned colour = 0; colour < blocks.colours(); ++colour) EXPECT_EQ(conflicts({colour}), 0u) << colour;
}

TEST_P(cell_blocks_test, merged_colours_are_detected) {
  for (unsigned colour = 1; colour < blocks.colours(); ++colour) {
    if (blocks.size(colour) == 0) continue;
    EXPECT_GT(conflicts({0, colour}), 0u) << colour;
  }
}

TEST(block_cut, goes_round_in_two_colours) {
  for (const std::int64_t period : {4, 6, 8, 10, 14, 50, 64})
    for (const std::int64_t width : {2, 3, 4, 5, 8, 16}) {
      const block_cut cut(width, period);
      ASSERT_EQ(cut.fits(), 2 * width <= period);
      if (!cut.fits()) continue;
      const std::int64_t blocks = cut.block_of(period - 1) + 1;
      EXPECT_EQ(blocks % 2, 0);
      std::vector<std::int64_t> cells(static_cast<std::size_t>(blocks), 0);
      for (std::int64_t cell = 0, last = 0; cell < period; ++cell) {
        const std::int64_t block = cut.block_of(cell);
        ASSERT_TRUE(block == last || block == last + 1) << "in order, from 0";
        ++cells[static_cast<std::size_t>(last = block)];
      }
      for (const std::int64_t n : cells) {
        EXPECT_GE(n, width);
        EXPECT_LT(n, 2 * width + 1);
      }
      for (std::int64_t cell = 0; cell < period && period % (2 * width) == 0; ++cell)
        EXPECT_EQ(cut.block_of(cell), cell / width);
    }
}

TEST(block_cut, leaves_an_axis_of_3_cells_whole) {
  for (const std::int64_t width : {2, 3, 16}) {
    EXPECT_TRUE(block_cut(width, 3).fits());
    for (std::int64_t cell = 0; cell < 3; ++cell) EXPECT_EQ(block_cut(width, 3).block_of(cell), 0);
  }
}

TEST(cell_blocks, one_pass_has_them_all) {
  const indexed_scene s(make_scene("dam_break", 0.05, "rest"), 3);
  cell_blocks<3> blocks;
  blocks.shape(block_shape{3, 3}, true);
  blocks.build(s.index.view());
  ASSERT_EQ(blocks.colours(), 1u);
  std::set<std::uint32_t> seen;
  for (std::size_t b = 0; b < blocks.size(0); ++b) seen.insert(blocks(0, b).begin(), blocks(0, b).end());
  EXPECT_EQ(seen.size(), s.index.view().fluid_cells);
}

TEST(cell_blocks, what_does_not_go_round_a_torus_is_refused_or_not_chosen) {
  const indexed_scene s(make_scene("dam_break", 0.08, "rest"), 3);
  cell_blocks<3> blocks;
  blocks.shape(block_shape{1, 5});
  EXPECT_EQ(error_of([&] { blocks.build(s.index.view()); }),
            "blocks of 5 cells do not fit around a torus of 8 cells in two colours: they may be up to 4 cells wide");
  blocks.shape(block_limits{1 << 20, 1});
  EXPECT_EQ(error_of([&] { blocks.build(s.index.view()); }), "");
}

TEST(cell_blocks, cells_are_visited_in_the_order_of_the_grid) {
  cells<3> c;
  c.fluid_cells = 64;
  c.resize_fluid();
  for (int k = 0; k < 64; ++k) c.place[static_cast<std::size_t>(k) + 1] = ivec<3>{k % 4, k / 4 % 4, k / 16};
  cell_blocks<3> blocks;
  blocks.shape(block_shape{3, 2});
  blocks.build(c);
  const auto second = blocks(1, 0);
  EXPECT_EQ(std::vector<std::uint32_t>(second.begin(), second.end()),
            (std::vector<std::uint32_t>{3, 4, 7, 8, 19, 20, 23, 24}));
}

TEST(cell_blocks, follow_cells_that_move) {
  cells<3> c;
  c.fluid_cells = 2;
  c.resize_fluid();
  c.place[1] = ivec<3>{0, 0, 0};
  c.place[2] = ivec<3>{0, 0, 9};
  cell_blocks<3> blocks;
  blocks.shape(block_shape{1, 2});
  blocks.build(c);
  EXPECT_EQ(blocks.size(0), 2u);
  c.place[2] = ivec<3>{0, 0, 1};
  blocks.build(c);
  EXPECT_EQ(blocks.size(0), 1u);
  c.period.fill(6);  // 3 blocks would go round, which two colours cannot: they are wider
  blocks.build(c);
  EXPECT_EQ(blocks.size(0), 1u);
  blocks.shape(block_shape{1, 4});
  EXPECT_TRUE(says(error_of([&] { blocks.build(c); }), {"do not fit around a torus of 6 cells"}));
  blocks.shape(block_shape{1, 2}, true);
  blocks.build(c);
  EXPECT_EQ(blocks.colours(), 1u);
}

TEST(cell_blocks, say_what_was_made) {
  cells<1> c;
  c.fluid_cells = 1;
  c.resize_fluid();
  c.place[1] = ivec<1>{0};
  cell_blocks<1> blocks;
  blocks.shape(block_shape{3, 4});
  blocks.build(c);
  EXPECT_EQ(blocks.shape().word(), "slab:4");
}

TEST(block_shape, is_read) {
  EXPECT_EQ(block_shape::parse("slab:2"), (block_shape{1, 2}));
  EXPECT_EQ(block_shape::parse("pencil:16"), (block_shape{2, 16}));
  EXPECT_EQ(block_shape::parse("brick:4096"), (block_shape{3, 4096}));
  for (const char* word : {"slab:2", "pencil:16", "brick:3"}) EXPECT_EQ(block_shape::parse(word).word(), word);
  for (const char* wrong : {"", "slab", "slab:", "slab:1", "slab:4097", "slab:2x", "tile:2", "brick:-2", "brick: 2",
                            "slab:2:", "slab:4:morton", "pencil:2:rows", "brick:4:bundles", ":2"})
    EXPECT_TRUE(says(error_of([&] { block_shape::parse(wrong); }), {"block must be auto, slab:N", wrong})) << wrong;
  EXPECT_EQ(error_of([] { check_block("auto"); }), "");
}

}  // namespace
}  // namespace pairsum

#include <gtest/gtest.h>

#include <thread>

#include <pairsum/schedule/cell_blocks.hpp>
#include "cloud.hpp"

// Which blocks `auto` makes: by the cache, by how many a colour needs, and by what goes round a torus.
namespace pairsum {
namespace {

constexpr std::size_t any = std::size_t{1} << 30;

/// Every cell of a box, row after row.
template <int D>
cells<D> every_cell(const ivec<D>& extent) {
  cells<D> c;
  c.fluid_cells = 1;
  for (const std::int64_t e : extent) c.fluid_cells *= static_cast<std::size_t>(e);
  c.resize_fluid();
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    auto rest = static_cast<std::int64_t>(cell) - 1;
    for (int d = 0; d < D; ++d) {
      c.place[cell][d] = rest % extent[d];
      rest /= extent[d];
    }
  }
  return c;
}

template <int D>
std::string chosen(const cells<D>& c, std::size_t cells_in_cache, std::size_t blocks) {
  return choose_block(c, {cells_in_cache, blocks}).word();
}

TEST(block_choice, takes_the_widest_pencils_that_fit_the_cache) {
  const auto c = every_cell<3>({8, 96, 96});
  EXPECT_EQ(chosen(c, any, 1), "pencil:16");
  EXPECT_EQ(chosen(c, 4 * 18 * 18, 1), "pencil:16");
  EXPECT_EQ(chosen(c, 4 * 18 * 18 - 1, 1), "pencil:8");
  EXPECT_EQ(chosen(c, 4 * 6 * 6, 1), "pencil:4");
  EXPECT_EQ(chosen(c, 4 * 4 * 4, 1), "pencil:2");
}

TEST(block_choice, leaves_each_colour_as_many_as_are_wanted) {
  const auto c = every_cell<3>({8, 48, 48});  // 3 x 3 pencils of 16, 6 x 6 of 8, 12 x 12 of 4
  EXPECT_EQ(chosen(c, any, 2), "pencil:16");
  EXPECT_EQ(chosen(c, any, 3), "pencil:8");
  EXPECT_EQ(chosen(c, any, 9), "pencil:8");
  EXPECT_EQ(chosen(c, any, 10), "pencil:4");
  EXPECT_EQ(chosen(c, any, 36), "pencil:4");
  EXPECT_EQ(chosen(c, any, 144), "pencil:2");
}

/// A long channel has too few pencils, and a few cells too few of anything.
TEST(block_choice, takes_bricks_where_pencils_are_too_few) {
  EXPECT_EQ(chosen(every_cell<3>({4096, 4, 4}), any, 12), "brick:16");
  EXPECT_EQ(chosen(every_cell<3>({4096, 4, 4}), 6 * 6 * 6, 12), "brick:4");
  EXPECT_EQ(chosen(every_cell<3>({4, 4, 4}), any, 12), "brick:2");
  EXPECT_EQ(chosen(every_cell<3>({64, 64, 64}), 1, 1), "brick:2") << "nothing fits";
}

/// Full bricks are not counted one by one; scattered cells are.
TEST(block_choice, bricks_of_few_cells) {
  auto c = every_cell<3>({4096, 4, 4});
  std::size_t kept = 0;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
    if (c.place[cell][0] % 64 == 0) c.place[++kept] = c.place[cell];
  c.fluid_cells = kept;  // 64 places along the first axis
  EXPECT_EQ(chosen(c, any, 8), "brick:16");
  EXPECT_EQ(chosen(c, any, 9), "brick:2");
}

TEST(block_choice, counts_only_places_with_fluid) {
  auto c = every_cell<3>({2, 64, 64});
  EXPECT_EQ(chosen(c, any, 4), "pencil:16");
  std::size_t kept = 0;  // a wedge: of 16 cells there are 3 pencils, of 8 cells 10, of 4 cells 36
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
    if (c.place[cell][1] + c.place[cell][2] < 32) c.place[++kept] = c.place[cell];
  c.fluid_cells = kept;
  EXPECT_EQ(chosen(c, any, 2), "pencil:8");
  EXPECT_EQ(chosen(c, any, 4), "pencil:4");
}

TEST(block_choice, in_fewer_dimensions) {
  EXPECT_EQ(chosen(every_cell<2>({100, 100}), any, 3), "slab:16");
  EXPECT_EQ(chosen(every_cell<2>({100, 100}), any, 12), "slab:4");
  EXPECT_EQ(chosen(every_cell<2>({1000, 4}), any, 12), "pencil:16");
  EXPECT_EQ(chosen(every_cell<1>({1000}), any, 12), "slab:16");
  EXPECT_EQ(chosen(every_cell<1>({10}), any, 12), "slab:2");
}

TEST(block_choice, goes_round_a_torus) {
  auto c = every_cell<3>({16, 16, 16});
  EXPECT_EQ(chosen(c, any, 0), "pencil:16");
  for (const int period : {4, 8, 16}) {
    c.period.fill(period);
    EXPECT_EQ(chosen(c, any, 0), "pencil:" + std::to_string(period / 2));
  }
}

TEST(block_choice, knows_the_machine) {
  const block_limits here = limits_of(2 << 20, 1024, 16);
  EXPECT_EQ(here.cells, 1024u);
  EXPECT_EQ(here.blocks, 96u);
  const block_limits unsaid = limits_of(0, 1024, 0);
  EXPECT_EQ(unsaid.cells, 512u);
  EXPECT_EQ(unsaid.blocks, 6 * std::max(1u, std::thread::hardware_concurrency()));
}

TEST(block_choice, is_what_cell_blocks_make) {
  const auto c = every_cell<3>({8, 48, 48});
  cell_blocks<3> blocks;
  blocks.shape(block_limits{any, 36});
  blocks.build(c);
  EXPECT_EQ(blocks.shape().word(), "pencil:4");
  ASSERT_EQ(blocks.colours(), 4u);
  for (unsigned colour = 0; colour < 4; ++colour) EXPECT_EQ(blocks.size(colour), 36u);
  blocks.build(every_cell<3>({8, 24, 24}));  // the fluid moves, and the choice with it
  EXPECT_EQ(blocks.shape().word(), "pencil:2");
  blocks.shape(block_shape{1, 6});
  blocks.build(c);
  EXPECT_EQ(blocks.shape().word(), "slab:6");
}

}  // namespace
}  // namespace pairsum

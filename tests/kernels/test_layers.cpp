#include <pairsum/schedule/layers.hpp>

#include <gtest/gtest.h>

#include <set>

#include <pairsum/core/random.hpp>
#include "torus.hpp"

// Layers of cells: runs of cells along the slowest axis, and where a half stencil goes from them.
namespace pairsum {
namespace {

using namespace test_kit;

template <int D>
void expect_layers(std::int64_t period, std::int64_t extent, int one_in) {
  const counter_random random(static_cast<std::uint64_t>(extent));
  std::uint64_t n = 0;
  const cells<D> c = make_cells<D>(period, extent, [&](const ivec<D>&) { return random.bits(n++) % one_in == 0; });
  std::vector<cell_layer> layers;
  find_layers(c, layers);
  std::uint32_t next = 1;
  for (const cell_layer& layer : layers) {
    ASSERT_EQ(layer.begin, next);
    ASSERT_LT(layer.begin, layer.end);
    for (; next < layer.end; ++next) ASSERT_EQ(c.place[next][D - 1], layer.at);
    const std::set<std::int64_t> reach{layer.at, layer_after(layer.at, layers_around(c))};
    for (std::uint32_t cell = layer.begin; cell < layer.end; ++cell)
      for (unsigned code = pattern::stencil_centre<D> + 1; code < cells<D>::stencil; ++code)
        if (const auto to = c.neighbour(cell, code); to != 0) {
          ASSERT_TRUE(reach.contains(c.place[to][D - 1]));
        }
    if (next <= c.fluid_cells) {
      ASSERT_NE(c.place[next][D - 1], layer.at);
    }
  }
  EXPECT_EQ(next, c.fluid_cells + 1);
}

TEST(layers, are_found_and_a_half_stencil_goes_to_the_next_alone) {
  for (const std::int64_t period : {0, 3, 4, 6, 10})
    for (const int one_in : {1, 3, 40}) {
      expect_layers<1>(period, 200, one_in);
      expect_layers<2>(period, 30, one_in);
      expect_layers<3>(period, 11, one_in);
    }
}

}  // namespace
}  // namespace pairsum

#include <pairsum/schedule/slab_colours.hpp>

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "layers_at.hpp"

// Slabs of layers in two colours: no two of a colour write to a layer, on rings of any length.
namespace pairsum {
namespace {

using namespace test_kit;

/// Layers that two slabs of a colour write to; `merged`: as if there were one colour.
int conflicts(const slab_colours& cut, std::int64_t around, std::int64_t layers, bool merged = false) {
  std::map<std::pair<unsigned, std::int64_t>, std::set<std::int64_t>> writers;
  for (std::int64_t at = 0; at < layers; ++at)
    for (const std::int64_t to : {at, layer_after(at, around)})
      writers[{merged ? 0 : slab_colours::colour_of(cut.slab_of(at)), to}].insert(cut.slab_of(at));
  return static_cast<int>(std::ranges::count_if(writers, [](const auto& w) { return w.second.size() > 1; }));
}

TEST(slab_colours, no_two_slabs_of_a_colour_write_to_a_layer) {
  for (const std::int64_t thickness : {2, 3, 4, 8, 100})
    for (std::int64_t around = 4; around <= 67; ++around) {
      const slab_colours cut(thickness, around);
      EXPECT_EQ(conflicts(cut, around, around), 0) << around << " layers, thickness " << thickness;
      EXPECT_GT(conflicts(cut, around, around, true), 0) << "merged colours";
      std::map<std::int64_t, int> layers;
      for (std::int64_t at = 0; at < around; ++at) ++layers[cut.slab_of(at)];
      const auto slabs = static_cast<std::int64_t>(layers.size());
      EXPECT_EQ(slabs, std::max<std::int64_t>(2, around / (2 * thickness) * 2));
      EXPECT_EQ(layers.begin()->first, 0);
      EXPECT_EQ(layers.rbegin()->first, slabs - 1) << "numbered without a gap";
      for (const auto& [slab, n] : layers) {
        EXPECT_EQ(cut.slab_of(slab * around / slabs), slab);
        EXPECT_GE(n, std::min(thickness, around / 2));
      }
    }
  for (std::int64_t at = 0; at < 3; ++at) EXPECT_EQ(slab_colours(2, 3).slab_of(at), 0) << "3 layers are one slab";
  for (const std::int64_t thickness : {2, 3, 64}) {
    EXPECT_EQ(conflicts(slab_colours(thickness, 0), 0, 500), 0);
    EXPECT_GT(conflicts(slab_colours(thickness, 0), 0, 500, true), 0);
  }
}

TEST(slab_colours, hold_each_cell_once) {
  const auto layers = layers_at(0b1011'0111'0010);
  const auto slabs = coloured_slabs(layers, slab_colours(2, 12));
  const auto all = [&](unsigned colour) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> cells;
    for (const slab_cells& s : slabs[colour]) cells.emplace_back(s.begin, s.end);
    return cells;
  };
  EXPECT_EQ(all(0), (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{1, 2}, {2, 4}, {5, 7}}));
  EXPECT_EQ(all(1), (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{4, 5}, {7, 8}}));
}

TEST(slab_colours, are_thick_where_layers_are_few_particles) {
  EXPECT_EQ(slab_thickness(0, 0), 2);
  EXPECT_EQ(slab_thickness(1000000, 50), 2);
  EXPECT_EQ(slab_thickness(1000000, 500), 2);
  EXPECT_EQ(slab_thickness(100000, 1000), 4) << "else fewer than 128 are left";
  EXPECT_EQ(slab_thickness(1000000, 500000), 1024);
}

}  // namespace
}  // namespace pairsum

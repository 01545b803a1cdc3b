#include <gtest/gtest.h>

#include <set>

#include <pairsum/core/random.hpp>
#include <pairsum/core/tbb_arena.hpp>
#include "indexed_scene.hpp"

namespace pairsum {
namespace {

using namespace test_kit;
using key = std::array<int, 3>;

class indexer_test : public testing::TestWithParam<grid_choice> {
 protected:
  indexed_scene s{make_scene("dam_break", 0.05, "perturbed"), GetParam(), team::omp(3)};
  const cells<3>& c = s.index.view();

  /// Cells of the box around all particles.
  std::size_t box_cells() const {
    std::size_t n = 1;
    for (int d = 0; d < 3; ++d) {
      std::set<int> seen;
      for (std::size_t i = 0; i < s.particles.size(); ++i) seen.insert(s.cell_of(i)[d]);
      n *= static_cast<std::size_t>(*seen.rbegin() - *seen.begin() + 1);
    }
    return n;
  }
  key key_of(std::size_t cell) const {
    const cell_range& r = c.range[cell];
    return s.cell_of(r.fluid.size() > 0 ? r.fluid.begin : r.boundary.begin);
  }
};
INSTANTIATE_TEST_SUITE_P(grid, indexer_test, testing::ValuesIn(every_grid({2, 3, 5, 7})));

TEST_P(indexer_test, fluid_before_boundary_before_lost) {
  s.particles.x[1][5] = -1;  // two fluid particles leave
  s.particles.x[2][9] = 1e9;
  s.index.build(s.particles, team::omp(2));
  EXPECT_EQ(s.index.lost(), 2u);
  const std::size_t fluid = s.index.fluid(), boundary = s.index.boundary(), n = s.particles.size();
  EXPECT_EQ(fluid + boundary + 2, n);
  for (std::size_t i = 0; i < n; ++i)
    ASSERT_EQ(s.particles.kind[i], i < fluid              ? particle_kind::fluid
                                   : i < fluid + boundary ? particle_kind::boundary
                                                          : particle_kind::lost);
  s.index.build(s.particles, team::omp(2));
  EXPECT_EQ(s.index.lost(), 0u) << "only newly lost particles count";
  EXPECT_EQ(s.index.fluid(), fluid);
}

TEST_P(indexer_test, cells_partition_the_particles_in_contiguous_ranges) {
  std::uint32_t fluid = 0;
  std::set<std::uint32_t> boundary;
  EXPECT_EQ(c.range[0].fluid.size() + c.range[0].boundary.size(), 0u);
  for (std::size_t cell = 1; cell < c.range.size(); ++cell) {
    const cell_range& r = c.range[cell];
    if (cell <= c.fluid_cells) {
      ASSERT_EQ(r.fluid.begin, fluid) << "cell " << cell;
      ASSERT_GT(r.fluid.size(), 0u);
      fluid = r.fluid.end;
    } else {
      ASSERT_EQ(r.fluid.size(), 0u);
      ASSERT_GT(r.boundary.size(), 0u);
    }
    for (auto i = r.boundary.begin; i < r.boundary.end; ++i) ASSERT_TRUE(boundary.insert(i).second);
  }
  EXPECT_EQ(fluid, s.index.fluid());
  ASSERT_EQ(boundary.size(), s.index.boundary());
  EXPECT_EQ(*boundary.begin(), s.index.fluid());
  EXPECT_EQ(c.nonempty(), c.range.size() - 1);
  const grid_choice& grid = GetParam();
  EXPECT_EQ(c.total, grid.M > 0                  ? std::size_t{1} << 3 * grid.M
                     : grid.name == "dense_grid" ? box_cells()
                                                 : c.nonempty());
}

TEST_P(indexer_test, every_particle_is_in_the_cell_of_its_position) {
  std::set<key> keys;
  for (std::size_t cell = 1; cell < c.range.size(); ++cell) {
    const key k = key_of(cell);
    ASSERT_TRUE(keys.insert(k).second) << "two cells with one key";
    const cell_range& r = c.range[cell];
    for (auto i = r.fluid.begin; i < r.fluid.end; ++i) ASSERT_EQ(s.cell_of(i), k);
    for (auto i = r.boundary.begin; i < r.boundary.end; ++i) ASSERT_EQ(s.cell_of(i), k);
  }
}

TEST_P(indexer_test, neighbours_and_colours_are_those_of_the_torus) {
  std::map<key, std::uint32_t> at;
  for (std::uint32_t cell = 1; cell < c.range.size(); ++cell) at[key_of(cell)] = cell;
  const int mask = s.mask;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    const key own = key_of(cell);
    ASSERT_EQ(c.colour[cell], (own[0] & 1) | (own[1] & 1) << 1 | (own[2] & 1) << 2);
    for (unsigned n = 0; n < 27; ++n) {
      const key k{(own[0] + static_cast<int>(n % 3) - 1) & mask, (own[1] + static_cast<int>(n / 3 % 3) - 1) & mask,
                  (own[2] + static_cast<int>(n / 9) - 1) & mask};
      ASSERT_EQ(c.neighbour(cell, n), at.contains(k) ? at[k] : 0u) << "cell " << cell << " code " << n;
    }
  }
}

/// The cells as sets of ids, whatever the order inside a cell.
std::map<key, std::set<std::uint32_t>> contents(const indexed_scene& s) {
  std::map<key, std::set<std::uint32_t>> found;
  const cells<3>& c = s.index.view();
  for (std::size_t cell = 1; cell < c.range.size(); ++cell) {
    const cell_range& r = c.range[cell];
    for (auto i = r.fluid.begin; i < r.fluid.end; ++i) found[s.cell_of(i)].insert(s.particles.id[i]);
    for (auto i = r.boundary.begin; i < r.boundary.end; ++i) found[s.cell_of(i)].insert(s.particles.id[i]);
  }
  return found;
}

TEST_P(indexer_test, build_after_small_moves_equals_a_fresh_build) {
  scene moved = make_scene("dam_break", 0.05, "perturbed");
  const auto before = contents(s);
  const counter_random random(5);
  for (std::size_t k = 0; k < s.particles.size(); ++k)
    for (int d = 0; d < 3; ++d) {
      const std::uint32_t id = s.particles.id[k];
      if (s.particles.kind[k] == particle_kind::fluid)
        s.particles.x[d][k] += random.uniform(3 * id + static_cast<unsigned>(d), 0, 0.02);
      moved.particles.x[d][id] = s.particles.x[d][k];
    }
  s.index.build(s.particles, team::omp(2));
  const indexed_scene fresh(moved, GetParam());
  const auto after = contents(s);
  EXPECT_EQ(after, contents(fresh));
  EXPECT_NE(after, before) << "nothing moved to another cell: the test tests nothing";
  EXPECT_EQ(c.neighbours.size(), fresh.index.view().neighbours.size());
  EXPECT_EQ(c.fluid_cells, fresh.index.view().fluid_cells);
  // cells are numbered by key, so the tables must agree (their entries 0..26 belong to no cell)
  for (std::size_t n = 27; n < c.neighbours.size(); ++n) ASSERT_EQ(c.neighbours[n], fresh.index.view().neighbours[n]);
}

TEST_P(indexer_test, is_identical_for_every_team) {
  const scene start = make_scene("dam_break", 0.05, "perturbed");
  tbb_arena arena(3);
  for (const team& t : {team(), team::omp(2), team::omp(7), team::tbb(3, arena)}) {
    const indexed_scene other(start, GetParam(), t);
    EXPECT_EQ(other.particles.id, s.particles.id);
    EXPECT_EQ(other.particles.x, s.particles.x);
    EXPECT_EQ(other.index.view().fluid_cells, c.fluid_cells);
  }
}

}  // namespace
}  // namespace pairsum

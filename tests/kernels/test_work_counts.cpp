#include <gtest/gtest.h>

#include "indexed_scene.hpp"
#include "periodic_box.hpp"

// The work that backends report, recomputed from the cells: who holds fluid, and who is whose
// neighbour on the torus.
namespace pairsum {
namespace {

using namespace test_kit;

struct work {
  std::uint64_t cells = 0, fluid_cells = 0, cell_pairs = 0, fluid_tests = 0, boundary_tests = 0;
};

/// With `parts` cells to the reach, a reach that is longer by `skin` of H.
work by_hand(const scene& s, const grid_choice& grid, int parts, double skin) {
  scene wide = s;
  wide.world.constants.H *= 1 + skin;
  const indexed_scene indexed(wide, grid);
  struct content {
    std::uint64_t fluid = 0, boundary = 0;
  };
  std::map<std::array<int, 3>, content> cell;
  for (std::size_t i = 0; i < indexed.particles.size(); ++i) {
    content& c = cell[indexed.cell_of(i, parts)];
    (indexed.particles.kind[i] == particle_kind::fluid ? c.fluid : c.boundary) += 1;
  }
  work n;
  n.cells = cell.size();
  const int edge = 2 * parts + 1, neighbours = edge * edge * edge;
  for (const auto& [at, own] : cell) {
    n.fluid_cells += own.fluid > 0;
    n.fluid_tests += own.fluid * (own.fluid - (own.fluid > 0)) / 2;
    n.boundary_tests += own.fluid * own.boundary;
    for (int code = 0; code < neighbours; ++code) {
      const auto to = indexed.turned(
          {at[0] + code % edge - parts, at[1] + code / edge % edge - parts, at[2] + code / edge / edge - parts}, parts);
      const auto other = cell.find(to);
      if (other == cell.end() || other->first <= at) continue;  // each pair of cells once
      n.cell_pairs += own.fluid > 0 || other->second.fluid > 0;
      n.fluid_tests += own.fluid * other->second.fluid;
      n.boundary_tests += own.fluid * other->second.boundary + own.boundary * other->second.fluid;
    }
  }
  return n;
}

/// Pairs nearer than the reaches and the skin.
std::uint64_t listed_by_hand(const scene& s, double skin) {
  const particle_table& p = s.particles;
  const double H = s.world.constants.H;  // the boundary's reach too: what is counted is `count`
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      if (p.kind[i] == particle_kind::boundary && p.kind[j] == particle_kind::boundary) continue;
      double square = 0;
      for (std::size_t d = 0; d < 3; ++d) {
        const double edge = s.world.omega_high[d] - s.world.omega_low[d];
        const double r = p.x[d][i] - p.x[d][j], turns = s.world.periodic.on[d] ? std::round(r / edge) : 0;
        square += (r - turns * edge) * (r - turns * edge);
      }
      n += std::sqrt(square) < H * (1 + skin);
    }
  return n;
}

class work_counts_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(backend, work_counts_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

/// Expects it on these grids; one with an M of `unfolded` or none folds nothing.
void expect_work_of_cells(const std::string& backend, const scene& s, const std::vector<int>& all_M, int unfolded_M) {
  const auto oracle = registry::instance().make_reference(s.world)->cell_search(s.particles, some_threads());
  const auto& traits = registry::instance().find_backend(backend).traits;
  const bool as_grid = traits.cells_per_reach == 1 && traits.skin == 0;
  for (const grid_choice& grid : grids_round(with(s.world, backend, 2), all_M)) {
    const work expected = by_hand(s, grid, 1, traits.skin);
    const work visited = by_hand(s, grid, traits.cells_per_reach, traits.skin);
    const auto sum = evaluated(with(s.world, backend, grid), s.particles, 2);
    const auto fingerprint = sum->fingerprint();
    const work_counts n = sum->count_work();
    SCOPED_TRACE(testing::PrintToString(grid));
    if (grid.M > 0) {
      EXPECT_EQ(n.cells, std::uint64_t{1} << 3 * grid.M);
    } else if (grid.name == "compact_grid") {
      EXPECT_EQ(n.cells, expected.cells);
    }
    EXPECT_EQ(n.cells_nonempty, expected.cells);
    EXPECT_EQ(n.pairs_fluid_fluid, oracle.pairs_fluid_fluid);
    EXPECT_EQ(n.pairs_fluid_boundary, oracle.pairs_fluid_boundary);
    if (sum->traits().symmetric) {
      EXPECT_EQ(n.sumF1, visited.fluid_cells);
      EXPECT_EQ(n.sumF2, visited.cell_pairs);
      EXPECT_EQ(n.pairs_tested,
                traits.skin > 0 ? listed_by_hand(s, traits.skin) : visited.fluid_tests + visited.boundary_tests);
    } else {
      EXPECT_EQ(n.sumF1 + n.sumF2, 0u);
      EXPECT_EQ(n.pairs_tested, 2 * expected.fluid_tests + expected.boundary_tests);
    }
    if (as_grid && (grid.M == 0 || grid.M == unfolded_M)) {
      const auto unfolded = sum->count_unfolded_tests().value();
      EXPECT_EQ(n.pairs_tested, sum->traits().symmetric ? unfolded.symmetric : unfolded.gather);
    }
    EXPECT_EQ(sum->fingerprint(), fingerprint) << "counting must not disturb the rates";
  }
}

TEST_P(work_counts_test, are_those_of_the_cells) {
  expect_work_of_cells(GetParam(), make_scene("dam_break", 0.05, "perturbed"), {2, 3, 4, 6}, 6);
}
TEST_P(work_counts_test, are_those_of_the_cells_that_go_round_a_periodic_box) {
  scene s = make_scene("periodic_lattice", 0.0625, "perturbed");  // 8 H, of cells of H
  for (std::size_t i = 0; i < s.particles.size(); i += 7) s.particles.kind[i] = particle_kind::boundary;
  expect_work_of_cells(GetParam(), s, {2, 3}, 3);
  for (double& edge : s.world.omega_high) edge = 1.3;  // 10.4 H
  expect_work_of_cells(GetParam(), s, {2, 3}, 0);
}

}  // namespace
}  // namespace pairsum

#include <pairsum/sum/grids.hpp>

#include <gtest/gtest.h>

#include "any_world.hpp"
#include "cloud.hpp"

// The grids without M: what they refuse, that neither time nor memory grows with the world, and that they are the
// hashed grid with nothing folded.
namespace pairsum {
namespace {

using namespace test_kit;

const grid_choice dense{"dense_grid", 0}, compact{"compact_grid", 0};

TEST(grids, know_which_take_M) {
  EXPECT_EQ(grid_names(), (std::vector<std::string_view>{"hashed_grid", "dense_grid", "compact_grid"}));
  EXPECT_TRUE(grid_takes_M("hashed_grid"));
  EXPECT_FALSE(grid_takes_M("dense_grid"));
  EXPECT_FALSE(grid_takes_M("compact_grid"));
  EXPECT_TRUE(says(error_of([] { (void)grid_takes_M("tree"); }), {"grid", "\"tree\"", "dense_grid", "compact_grid"}));
}

TEST(grids, only_the_hashed_grid_looks_at_M) {
  const scene s = make_scene("lattice", 0.25, "rest");
  for (const int M : {-3, 0, 1, 40}) {
    for (const auto name : grid_names())
      EXPECT_EQ(error_of([&] { evaluated(with(s.world, "naive", {name, M}), s.particles); }) != "", grid_takes_M(name));
  }
}

class world_test : public testing::TestWithParam<world_kind> {};
INSTANTIATE_TEST_SUITE_P(every, world_test, testing::ValuesIn(world_kinds()),
                         [](const auto& i) { return testing::PrintToString(i.param); });

/// Same cells, same order, so the same bits as the hashed grid that folds nothing.
TEST_P(world_test, are_the_hashed_grid_with_nothing_folded) {
  const scene s = crowded_world(GetParam(), 14, 900);
  const auto hashed = evaluated(with(s.world, "symmetric", 5, "count"), s.particles);
  const auto tests = hashed->count_unfolded_tests().value();
  for (const grid_choice& grid : grids_without_M()) {
    const auto sum = evaluated(with(s.world, "symmetric", grid, "count"), s.particles);
    EXPECT_EQ(ids_in_order(*sum), ids_in_order(*hashed)) << grid;
    EXPECT_EQ(sum->fingerprint(), hashed->fingerprint()) << grid;
    EXPECT_EQ(sum->count_work().pairs_tested, hashed->count_work().pairs_tested) << grid;
    EXPECT_EQ(sum->count_work().pairs_tested, tests.symmetric) << grid;
    EXPECT_EQ(sum->count_work().cells_nonempty, hashed->count_work().cells_nonempty) << grid;
  }
}

TEST_P(world_test, a_million_H_of_world_takes_no_memory_with_compact_grid) {
  const scene s = sparse_world(GetParam(), 1e6, 1000);
  const setup world = with(s.world, "symmetric", compact, "count");
  const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, team());
  EXPECT_GT(expected.pairs_fluid_fluid, 500u);
  const std::size_t before = resident_bytes();
  const auto sum = evaluated(world, s.particles);
  EXPECT_LT(resident_bytes(), before + (std::size_t{8} << 20));
  EXPECT_EQ(disagreement(sum->rates(), expected), "");
  const work_counts n = sum->count_work();
  EXPECT_EQ(n.pairs_fluid_fluid, expected.pairs_fluid_fluid);
  EXPECT_EQ(n.cells, n.cells_nonempty);
  EXPECT_LE(n.cells, 1000u);
  EXPECT_EQ(n.pairs_tested, sum->count_unfolded_tests().value().symmetric);
  for (const char* backend : {"naive", "sphysics_sweep", "symmetric_omp"})
    EXPECT_EQ(disagreement(evaluated(with(s.world, backend, compact, "count"), s.particles, 3)->rates(), expected), "");
}

/// In a world as large, dense_grid serves particles that keep together, and else says what it would need.
TEST_P(world_test, dense_grid_refuses_what_it_cannot_hold_before_it_allocates) {
  scene s = sparse_world(GetParam(), 4e4, 1000);
  const std::size_t before = resident_bytes();
  const auto refusal = error_of([&] { evaluated(with(s.world, "symmetric", dense), s.particles); });
  EXPECT_EQ(refusal != "", GetParam().dim > 1) << refusal;  // 4e4, 1.6e9, 6.4e13 cells
  if (GetParam().dim > 1) {
    EXPECT_TRUE(says(refusal, {"dense_grid", " cells (", " bytes)", "2^30", "compact_grid works for any extent"}));
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
    EXPECT_LT(resident_bytes(), before + (std::size_t{8} << 20));
  }
  const double corner = s.world.omega_low[0], H = s.world.constants.H;
  for (auto& x : s.particles.x)
    for (double& a : x) a = corner + 2e4 * H + 3e-4 * (a - corner);  // all within 12 H, far from the corner of Omega
  const auto expected =
      registry::instance().make_reference(with(s.world, "naive", 2, "count"))->brute_force(s.particles, team());
  EXPECT_EQ(disagreement(evaluated(with(s.world, "symmetric", dense, "count"), s.particles)->rates(), expected), "");
}

TEST_P(world_test, a_precision_that_does_not_resolve_H_is_refused) {
  const double edges = GetParam().precision == "float" ? 1e7 : 1e16;
  const scene s = sparse_world(GetParam(), edges, 40);
  for (const grid_choice& grid : grids_without_M()) {
    const auto text = error_of([&] { evaluated(with(s.world, "naive", grid), s.particles); });
    EXPECT_TRUE(says(text, {grid.name, GetParam().precision, "does not resolve the support radius H"})) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
  EXPECT_FALSE(evaluated(with(s.world, "naive", 4), s.particles)->count_unfolded_tests()) << "no such grid";
}

/// Particles on every corner of Omega, and one alone on each of them.
TEST_P(world_test, the_box_may_touch_every_face_of_Omega) {
  scene s = crowded_world(GetParam(), 5.5, 0);
  const unsigned corners = 1u << GetParam().dim;
  const auto put = [&](unsigned copies, unsigned first, unsigned last) {
    s.particles.resize(copies * (last - first));
    for (unsigned k = 0; k < s.particles.size(); ++k) {
      for (int d = 0; d < GetParam().dim; ++d) {
        const bool high = (first + k / copies) >> d & 1;
        s.particles.x[d][k] = high ? s.world.omega_high[d] : s.world.omega_low[d];
        s.particles.v[d][k] = 0;
      }
      s.particles.rho[k] = 1000;
      s.particles.m[k] = 1;
      s.particles.kind[k] = particle_kind::fluid;
    }
  };
  for (const grid_choice& grid : grids_without_M()) {
    put(3, 0, corners);
    const auto sum = evaluated(with(s.world, "symmetric", grid, "count"), s.particles, 2);
    EXPECT_EQ(sum->rates().columns[0], std::vector<double>(3 * corners, 2)) << grid;
    EXPECT_EQ(sum->count_work().cells_nonempty, corners);
    for (unsigned corner = 0; corner < corners; ++corner) {
      put(1, corner, corner + 1);
      const auto alone = evaluated(with(s.world, "naive", grid, "count"), s.particles);
      EXPECT_EQ(alone->count_work().cells, 1u) << grid;
      EXPECT_EQ(alone->count_work().pairs_tested, 0u);
    }
  }
}

}  // namespace
}  // namespace pairsum

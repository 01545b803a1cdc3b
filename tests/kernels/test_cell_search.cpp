#include <gtest/gtest.h>

#include <cmath>

#include "scene.hpp"

// The reference's cell search against its own brute force: the same pairs, so equal up to the order
// of a long double sum.
namespace pairsum {
namespace {

using namespace test_kit;

class cell_search_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(interaction, cell_search_test, testing::Values("ferrari09", "count"));

TEST_P(cell_search_test, equals_brute_force) {
  for (const char* state : {"rest", "perturbed"}) {
    scene s = make_scene("dam_break", 0.055, state);
    s.particles.kind[10] = particle_kind::lost;
    const auto oracle = registry::instance().make_reference(with(s.world, "naive", 2, GetParam()));
    const expectation brute = oracle->brute_force(s.particles, some_threads());
    const expectation cell = oracle->cell_search(s.particles, team());
    EXPECT_EQ(cell.ids, brute.ids);
    EXPECT_EQ(cell.names, brute.names);
    EXPECT_EQ(cell.ids.size(), 999u) << "all fluid but the lost one";
    EXPECT_EQ(cell.pairs_fluid_fluid, brute.pairs_fluid_fluid);
    EXPECT_EQ(cell.pairs_fluid_boundary, brute.pairs_fluid_boundary);
    EXPECT_GT(brute.pairs_fluid_fluid, 9000u);
    for (std::size_t c = 0; c < brute.value.size(); ++c)
      for (std::size_t k = 0; k < brute.ids.size(); ++k) {
        ASSERT_LE(std::abs(cell.value[c][k] - brute.value[c][k]), brute.bound[c][k]);
        ASSERT_NEAR(cell.bound[c][k], brute.bound[c][k], 1e-12 * brute.bound[c][k]);
        ASSERT_NEAR(cell.magnitude[c][k], brute.magnitude[c][k], 1e-12 * brute.magnitude[c][k]);
      }
  }
}

TEST(brute_force, of_some_particles_is_that_of_all) {
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  const auto oracle = registry::instance().make_reference(with(s.world, "naive", 2));
  const expectation all = oracle->brute_force(s.particles, some_threads());
  const expectation some = oracle->brute_force(s.particles, team(), {200, 3, 77});
  EXPECT_EQ(some.ids, (std::vector<std::uint32_t>{200, 3, 77}));
  for (std::size_t c = 0; c < all.value.size(); ++c)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(some.value[c][k], all.value[c][some.ids[k]]);
      EXPECT_EQ(some.bound[c][k], all.bound[c][some.ids[k]]);
    }
}

/// Positions far from the origin and on both sides of it: floor, not truncation.
TEST(cell_search, works_around_and_far_from_the_origin) {
  for (const double shift : {0.0, -0.3, 1e5}) {
    scene s = make_scene("lattice", 0.125, "perturbed");
    for (auto& x : s.particles.x)
      for (double& a : x) a += shift;
    const auto oracle = registry::instance().make_reference(with(s.world, "naive", 2, "count"));
    const expectation brute = oracle->brute_force(s.particles, team());
    const expectation cell = oracle->cell_search(s.particles, team());
    EXPECT_EQ(cell.value, brute.value) << shift;
    EXPECT_GT(brute.pairs_fluid_fluid, 1000u);
  }
}

}  // namespace
}  // namespace pairsum

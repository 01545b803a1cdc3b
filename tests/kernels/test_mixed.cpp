#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <pairsum/core/random.hpp>
#include "scene.hpp"

// What precision mixed promises beyond its bound, which the tests of all formulas check: digits far from the origin,
// and momentum.
namespace pairsum {
namespace {

using namespace test_kit;

class mixed_test : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const auto built = registry::instance().precisions();
    if (std::ranges::count(built, "mixed") == 0) GTEST_SKIP() << "mixed is not built";
  }
  static bool float_is_built() { return std::ranges::count(registry::instance().precisions(), "float") > 0; }
  /// A dam break that begins so many H from the origin.
  static scene moved(double by) {
    scene s = make_scene("dam_break", 0.06, "perturbed");
    s.world.precision = "mixed";
    for (std::size_t d = 0; d < 3; ++d) {
      for (double& a : s.particles.x[d]) a += by * s.world.constants.H;
      s.world.omega_low[d] += by * s.world.constants.H;
      s.world.omega_high[d] += by * s.world.constants.H;
    }
    return s;
  }
  /// Largest |rate - reference| / sum of |terms|.
  static double error_of_rates(const scene& s, const std::string& precision) {
    setup world = with(s.world, GetParam(), grid_choice("compact_grid", 0));
    const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
    world.precision = precision;
    const rate_table u = evaluated(world, s.particles)->rates();
    double worst = 0;
    for (std::size_t c = 0; c < u.columns.size(); ++c)
      for (std::size_t k = 0; k < expected.ids.size(); ++k)
        if (expected.magnitude[c][k] > 0)
          worst = std::max(worst,
                           std::abs(u.columns[c][expected.ids[k]] - expected.value[c][k]) / expected.magnitude[c][k]);
    return worst;
  }
};
INSTANTIATE_TEST_SUITE_P(backend, mixed_test, testing::ValuesIn(backends_for({3, "mixed", "ferrari09", "wendland_c2"})),
                         [](const auto& i) { return i.param; });

TEST_P(mixed_test, keeps_its_digits_far_from_the_origin) {
  const scene near = moved(0), far = moved(1000);
  EXPECT_LT(error_of_rates(near, "mixed"), 1e-5);
  EXPECT_LT(error_of_rates(far, "mixed"), 1e-5);
  if (float_is_built()) {
    EXPECT_GT(error_of_rates(far, "float"), 1e-4) << "the measure sees what float loses";
  }
}

/// Rates of float are no rates of mixed: its bound is for state and pressures in double, wherever the origin is.
TEST_P(mixed_test, bound_rejects_float) {
  if (!float_is_built()) GTEST_SKIP() << "float is not built";
  for (const double by : {0, 1000}) {
    const scene s = moved(by);
    setup world = with(s.world, GetParam(), grid_choice("compact_grid", 0));
    const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
    EXPECT_EQ(disagreement(evaluated(world, s.particles)->rates(), expected), "") << by;
    world.precision = "float";
    EXPECT_NE(disagreement(evaluated(world, s.particles)->rates(), expected), "") << by;
  }
}

/// Positions lose nothing in a world of any width: the rounding of a place is all there is.
TEST_P(mixed_test, keeps_its_digits_in_a_wide_world) {
  scene s = moved(0);
  for (std::size_t d = 0; d < 3; ++d) s.world.omega_high[d] += 1e9 * s.world.constants.H;
  EXPECT_LT(error_of_rates(s, "mixed"), 1e-5);
}

/// Both sides of a pair of equal masses are the same float but for the sign, so they cancel as well as doubles add.
TEST_P(mixed_test, momentum_is_kept_in_double) {
  if (!registry::instance().find_backend(GetParam()).traits.symmetric) GTEST_SKIP() << "computes each pair twice";
  scene s = make_scene("lattice", 0.1, "rest");
  s.world.precision = "mixed";
  const counter_random random(5);
  for (std::uint32_t i = 0; i < s.particles.size(); ++i) {
    for (std::uint32_t d = 0; d < 3; ++d) {
      s.particles.x[d][i] += 0.02 * random.uniform(8 * i + d, -1, 1);
      s.particles.x[d][i] = std::clamp(s.particles.x[d][i], s.world.omega_low[d], s.world.omega_high[d]);
    }
    s.particles.rho[i] *= 1 + 0.01 * random.uniform(8 * i + 3, -1, 1);
    s.particles.kind[i] = particle_kind::fluid;
  }
  const rate_table u = evaluated(with(s.world, GetParam(), grid_choice("dense_grid", 0)), s.particles)->rates();
  for (std::size_t c = 1; c < 4; ++c) {
    double sum = 0, size = 0;
    for (const double a : u.columns[c]) sum += a, size += std::abs(a);
    EXPECT_GT(size, 0);
    EXPECT_LT(std::abs(sum), 1e-13 * size);
  }
}

TEST(mixed, is_refused_without_vector_units) {
  if (std::ranges::count(registry::instance().precisions(), "mixed") == 0) GTEST_SKIP() << "mixed is not built";
  setup s = make_scene("dam_break", 0.06, "rest").world;
  s.precision = "mixed";
  const auto refusal = [&](const std::string& backend, const std::string& interaction, const char* isa) {
    s.isa = isa;
    return error_of([&] { (void)registry::instance().make_summation(with(s, backend, 4, interaction)); });
  };
  for (const std::string& backend : backend_names()) {
    EXPECT_EQ(refusal(backend, "ferrari09", "default").empty(), backend != "atomic_add") << backend;
    EXPECT_NE(refusal(backend, "ferrari09", "scalar"), "") << backend;
  }
  EXPECT_TRUE(
      says(refusal("naive", "ferrari09", "scalar"), {"precision mixed needs vector units", "other than scalar"}));
  EXPECT_TRUE(says(refusal("atomic_add", "ferrari09", "default"), {"atomic_add", "cannot add atomically"}));
  EXPECT_TRUE(says(refusal("tiles_omp", "count", "best"), {"mixed was not built", "built: ", "ferrari09"}));
}

}  // namespace
}  // namespace pairsum

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pairsum/integrators/integrator.hpp>
#include "scene.hpp"

namespace pairsum {
namespace {

using namespace test_kit;

class euler_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(backend, euler_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

/// a + dt b rounded once or twice: both lie within two half-ulps.
void expect_step(double now, double before, double dt, double rate) {
  const double u = std::numeric_limits<double>::epsilon() / 2;
  EXPECT_NEAR(now, before + dt * rate, 2 * u * (std::abs(dt * rate) + std::abs(now)));
}

TEST_P(euler_test, one_step_is_the_formula) {
  const scene s = make_scene("dam_break", 0.06, "perturbed");
  const particle_table& before = s.particles;
  const double dt = 1e-3, g = 9.81;
  const auto sum = registry::instance().make_summation(with(s.world, GetParam(), 4));
  workers w(sum->traits().threads, 3);
  sum->load(before, {});
  int evaluations = 0;
  find_integrator("euler").step(
      *sum, dt, g, [&] { sum->evaluate(w.get()), ++evaluations; }, w.get());
  EXPECT_EQ(evaluations, 1);
  const particle_table now = sum->snapshot();
  const rate_table rates = sum->rates();  // those of the state before
  const auto e = registry::instance().make_reference(s.world)->brute_force(before, some_threads());
  ASSERT_EQ(disagreement(rates, e), "");
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before.kind[i] == particle_kind::boundary) {
      for (int d = 0; d < 3; ++d) {
        ASSERT_EQ(now.x[d][i], before.x[d][i]);
        ASSERT_EQ(now.v[d][i], before.v[d][i]);
      }
      ASSERT_EQ(now.rho[i], before.rho[i]);
      continue;
    }
    for (std::size_t d = 0; d < 3; ++d) {
      expect_step(now.x[d][i], before.x[d][i], dt, before.v[d][i]);
      expect_step(now.v[d][i], before.v[d][i], dt, rates.columns[1 + d][i] - (d == 1 ? g : 0));
    }
    expect_step(now.rho[i], before.rho[i], dt, rates.columns[0][i]);
    ASSERT_EQ(now.m[i], before.m[i]);
  }
}

/// Steps follow each other: the second starts where the first ended.
TEST_P(euler_test, steps_continue_from_the_new_state) {
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  const double dt = 1e-4;
  const auto one = registry::instance().make_summation(with(s.world, GetParam(), 4));
  const auto two = registry::instance().make_summation(with(s.world, GetParam(), 4));
  workers w(one->traits().threads, 1);
  const auto step = [&](summation& sum) {
    find_integrator("euler").step(
        sum, dt, 9.81, [&] { sum.evaluate(w.get()); }, w.get());
  };
  one->load(s.particles, {});
  for (int n = 0; n < 20; ++n) {
    two->load(n == 0 ? s.particles : one->snapshot(), {});
    step(*one);
    step(*two);
    const particle_table a = one->snapshot(), b = two->snapshot();
    for (std::size_t i = 0; i < a.size(); ++i)
      for (int d = 0; d < 3; ++d) ASSERT_NEAR(a.x[d][i], b.x[d][i], 1e-14) << "step " << n;
  }
  EXPECT_NE(one->snapshot().x, s.particles.x);
  EXPECT_EQ(one->lost(), 0u);
}

TEST_P(euler_test, an_interaction_without_dynamics_moves_nothing) {
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  const auto sum = registry::instance().make_summation(with(s.world, GetParam(), 4, "count"));
  workers w(sum->traits().threads, 2);
  sum->load(s.particles, {});
  find_integrator("euler").step(
      *sum, 1, 9.81, [&] { sum->evaluate(w.get()); }, w.get());
  EXPECT_EQ(sum->snapshot().x, s.particles.x);
  EXPECT_EQ(sum->snapshot().v, s.particles.v);
  EXPECT_GT(sum->rates().columns[0][0], 0);
}

TEST(integrators, unknown_name_lists_the_valid_ones) {
  EXPECT_TRUE(says(error_of([] { (void)find_integrator("leapforg"); }), {"integrator", "leapforg", "euler"}));
}

}  // namespace
}  // namespace pairsum

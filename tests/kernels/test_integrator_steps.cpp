#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "oscillator_scene.hpp"

// One step of every integrator against the formula of its scheme, written down here a second time.
namespace pairsum {
namespace {

using namespace test_kit;

const std::vector<std::string> integrators{"euler", "rk2", "predictor_corrector", "rk4"};
int order(const std::string& integrator) { return integrator == "euler" ? 1 : integrator == "rk4" ? 4 : 2; }

/// One step from y in long double, by the textbook's formula for the integrator.
template <class F>
unknowns by_hand(const std::string& integrator, F&& f, const unknowns& y, long double dt) {
  const unknowns k1 = f(y);
  if (integrator == "euler") return plus(y, dt, k1);
  if (integrator == "rk2") return plus(plus(y, dt / 2, k1), dt / 2, f(plus(y, dt, k1)));
  const unknowns k2 = f(plus(y, dt / 2, k1));
  if (integrator == "predictor_corrector") return plus(y, dt, k2);  // 2 (y + dt/2 k2) - y
  const unknowns k3 = f(plus(y, dt / 2, k2)), k4 = f(plus(y, dt, k3));
  return plus(plus(plus(plus(y, dt / 6, k1), dt / 3, k2), dt / 3, k3), dt / 6, k4);
}

struct words {
  std::string integrator, backend, precision;
  int D;
};
std::ostream& operator<<(std::ostream& o, const words& w) {
  return o << w.integrator << " " << w.backend << " " << w.precision << " " << w.D << "D";
}
std::vector<words> all_words() {
  std::vector<words> all;
  for (const std::string& i : integrators)
    for (const char* b : {"naive", "symmetric"})
      for (const combination& c : oscillator_registry().formulas())
        if (c.interaction == "oscillators") all.push_back({i, b, c.precision, c.dim});
  return all;
}

class integrator_steps_test : public testing::TestWithParam<words> {
 protected:
  const std::string integrator = GetParam().integrator;
  const int D = GetParam().D;
  int evaluations = 0;
  std::unique_ptr<summation> sum;

  /// The particles after some steps of dt.
  particle_table after(const scene& s, double dt, double gravity, int steps = 1) {
    setup w = s.world;
    w.backend = GetParam().backend;
    w.precision = GetParam().precision;
    sum = oscillator_registry().make_summation(w);
    workers team_of(sum->traits().threads, 2);
    sum->load(s.particles, {});
    evaluations = 0;
    for (int n = 0; n < steps; ++n)
      find_integrator(integrator)
          .step(
              *sum, dt, gravity, [&] { sum->evaluate(team_of.get()), ++evaluations; }, team_of.get());
    return sum->snapshot();
  }
  /// Ten roundings of numbers up to 20.
  double tolerance() const {
    return 200 * (GetParam().precision == "float" ? std::numeric_limits<float>::epsilon()
                                                  : std::numeric_limits<double>::epsilon());
  }
};
INSTANTIATE_TEST_SUITE_P(words, integrator_steps_test, testing::ValuesIn(all_words()), [](const auto& i) {
  return i.param.integrator + "_" + i.param.backend + "_" + std::to_string(i.param.D) + "D_" + i.param.precision;
});

TEST_P(integrator_steps_test, a_step_is_the_formula_of_the_scheme) {
  const double dt = 0.125, gravity = 9.81;
  const scene s = make_oscillators(D, 1);
  const auto f = [&](const unknowns& y) { return derivative(s, gravity, y); };
  const unknowns before = unknowns_of(s.particles), now = unknowns_of(after(s, dt, gravity));
  EXPECT_EQ(evaluations, order(integrator)) << "summations per step";
  for (const std::string& other : integrators) {
    const long double error = difference(now, by_hand(other, f, before, dt));
    EXPECT_EQ(error <= tolerance(), other == integrator) << other << " differs by " << error;
  }
}

/// y' = L y: a step of order p with p stages is the Taylor polynomial of exp(dt L) of degree p.
TEST_P(integrator_steps_test, a_step_of_a_linear_problem_is_a_taylor_polynomial) {
  const double dt = 0.125;
  const scene s = make_oscillators(D, 0);
  const unknowns zero(oscillator_count, {0, 0, 0, 0, 0, 0, 0});
  unknowns term = unknowns_of(s.particles), y = term;
  for (int n = 1; n <= order(integrator); ++n) {
    term = plus(zero, dt / n, derivative(s, 0, term));
    y = plus(y, 1, term);
  }
  const unknowns now = unknowns_of(after(s, dt, 0));
  EXPECT_LE(difference(now, y), tolerance());
  EXPECT_GT(difference(now, plus(y, -1, term)), tolerance()) << "one degree less is rejected";
}

/// On top of springs that see relative positions alone, a fall is the same for all.
TEST_P(integrator_steps_test, gravity_acts_along_minus_y_or_in_1D_along_minus_x) {
  const double dt = 0.125, g = 2;
  const scene s = make_oscillators(D, 0);
  const unknowns falling = unknowns_of(after(s, dt, g)), floating = unknowns_of(after(s, dt, 0));
  const int up = D == 1 ? 0 : 1;
  for (std::size_t i = 0; i < oscillator_count; ++i)
    for (int c = 0; c < 2 * D + 1; ++c) {
      const double fall = c == up ? (integrator == "euler" ? 0 : -g * dt * dt / 2) : c == D + up ? -g * dt : 0;
      EXPECT_NEAR(static_cast<double>(falling[i][c] - floating[i][c]), fall, tolerance());
    }
}

TEST_P(integrator_steps_test, an_interaction_without_dynamics_moves_nothing) {
  scene s = make_oscillators(D, 1);
  s.world.interaction = "count";
  const particle_table now = after(s, 0.125, 9.81, 2);
  EXPECT_EQ(evaluations, 2 * order(integrator));
  EXPECT_EQ(now.x, s.particles.x);
  EXPECT_EQ(now.v, s.particles.v);
  EXPECT_EQ(now.rho, s.particles.rho);
  EXPECT_EQ(sum->rates().columns[0][0], 3) << "a cluster's other particles";
}

TEST_P(integrator_steps_test, boundary_particles_stay) {
  const scene s = make_oscillators(D, 1);
  const particle_table now = after(s, 0.125, 9.81, 3);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const bool moved = now.x[0][i] != s.particles.x[0][i];
    EXPECT_EQ(moved, i < oscillator_count);
    if (moved) continue;
    EXPECT_EQ(now.kind[i], particle_kind::boundary);
    for (int d = 0; d < D; ++d) {
      EXPECT_EQ(now.x[d][i], s.particles.x[d][i]);
      EXPECT_EQ(now.v[d][i], 0);
    }
  }
}

/// A particle without neighbours leaves Omega by the second stage of the second step, or, with one stage, between
/// steps.
TEST_P(integrator_steps_test, a_particle_that_leaves_within_a_step_is_lost_and_the_others_go_on) {
  const double dt = 0.0625;
  scene s = make_oscillators(D, 1);
  const std::uint32_t leaver = 6;
  const auto leave = [&](double speed) {
    for (int d = 0; d < D; ++d) s.particles.x[d][leaver] = d == 0 ? 19 : 8, s.particles.v[d][leaver] = 0;
    s.particles.v[0][leaver] = speed;
  };
  leave(0);
  const particle_table with_all = after(s, dt, 1, 3);
  EXPECT_EQ(sum->lost(), 0u);
  leave(0.75 / dt);  // at 19.75 after a step; beyond 20 after half a step more
  const particle_table now = after(s, dt, 1, 3);
  EXPECT_EQ(sum->lost(), 1u);
  EXPECT_EQ(evaluations, 3 * order(integrator));
  EXPECT_EQ(now.kind[leaver], particle_kind::lost);
  EXPECT_GT(now.x[0][leaver], 20);
  EXPECT_LT(now.x[0][leaver], 20.75) << "it stays where it was lost";
  for (std::uint32_t i = 0; i < oscillator_count; ++i) {
    if (i == leaver) continue;
    EXPECT_EQ(now.kind[i], particle_kind::fluid);
    for (int d = 0; d < D; ++d) {
      EXPECT_NEAR(now.x[d][i], with_all.x[d][i], tolerance());
      EXPECT_NEAR(now.v[d][i], with_all.v[d][i], tolerance());
    }
    EXPECT_NEAR(now.rho[i], with_all.rho[i], tolerance());
  }
}

}  // namespace
}  // namespace pairsum

#include <gtest/gtest.h>

#include <cmath>

#include <pairsum/integrators/with_state.hpp>
#include "oscillator_scene.hpp"

// The measured order of convergence of every integrator, on a problem whose particles change places in memory between
// the stages of a step.
namespace pairsum {
namespace {

using namespace test_kit;

constexpr double duration = 1, gravity = 1;

/// Is every pair of a cluster well within H = 1 and every other pair well beyond it? The problem is smooth only then.
bool clear_of_H(const unknowns& y, int D) {
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      long double r2 = 0;
      for (int d = 0; d < D; ++d) r2 += (y[i][d] - y[j][d]) * (y[i][d] - y[j][d]);
      if (i % 4 == j % 4 ? r2 > 0.9L : r2 < 1.1L) return false;
    }
  return true;
}

/// The exact solution, as good as: the classical Runge-Kutta method in long double in short steps.
unknowns exact_solution(const scene& s) {
  constexpr int steps = 1000;
  const long double dt = duration / static_cast<long double>(steps);
  const auto f = [&](const unknowns& y) { return derivative(s, gravity, y); };
  unknowns y = unknowns_of(s.particles);
  for (int n = 0; n < steps; ++n) {
    if (!clear_of_H(y, s.world.dim)) throw error("a pair comes near r = H");
    const unknowns a = f(y), b = f(plus(y, dt / 2, a)), c = f(plus(y, dt / 2, b)), d = f(plus(y, dt, c));
    y = plus(plus(plus(plus(y, dt / 6, a), dt / 3, b), dt / 3, c), dt / 6, d);
  }
  return y;
}

struct run {
  unknowns y;
  int evaluations = 0;
  int moved = 0;  ///< evaluations within a step that changed the order of memory
};

/// Integrates over `duration`. With `leave_behind`, what the integrator keeps with the particles stays in its place in
/// memory when the particles move.
run integrate(const scene& s, const std::string& integrator, const std::string& backend, int steps,
              bool leave_behind = false) {
  setup w = s.world;
  w.backend = backend;
  const auto sum = oscillator_registry().make_summation(w);
  workers team_of(sum->traits().threads, 2);
  sum->load(s.particles, {});
  run r;
  bool first = false;
  const auto evaluate = [&] {
    with_state(*sum, [&](auto& st) {
      auto& p = st.particles();
      const auto ids = p.id;
      const auto carried = p.carried;
      sum->evaluate(team_of.get());
      if (leave_behind) p.carried = carried;
      r.moved += !first && p.id != ids;
    });
    ++r.evaluations;
    first = false;
  };
  for (int n = 0; n < steps; ++n) {
    first = true;
    find_integrator(integrator).step(*sum, duration / steps, gravity, evaluate, team_of.get());
  }
  const particle_table now = sum->snapshot();
  r.y = unknowns_of(now);
  EXPECT_EQ(sum->lost(), 0u);
  for (std::size_t i = oscillator_count; i < now.size(); ++i)  // boundary particles
    for (int d = 0; d < now.dim; ++d) {
      EXPECT_EQ(now.x[d][i], s.particles.x[d][i]);
      EXPECT_EQ(now.v[d][i], s.particles.v[d][i]);
    }
  return r;
}

struct scheme {
  std::string name;
  int order, evaluations;
};
std::ostream& operator<<(std::ostream& o, const scheme& s) { return o << s.name; }
const std::vector<scheme> schemes{{"euler", 1, 1}, {"rk2", 2, 2}, {"predictor_corrector", 2, 2}, {"rk4", 4, 4}};

class integrators_test : public testing::TestWithParam<std::tuple<scheme, std::string, int>> {
 protected:
  const scheme with = std::get<0>(GetParam());
  const std::string backend = std::get<1>(GetParam());
  const int D = std::get<2>(GetParam());
  const scene s = make_oscillators(D, 1);
  const unknowns exact = exact_solution(s);

  unknowns result(int steps, bool leave_behind = false) const {
    return integrate(s, with.name, backend, steps, leave_behind).y;
  }
  /// The observed order of components [begin, end): how much smaller the error is after twice as many steps.
  double order(const unknowns& coarse, const unknowns& fine, int begin, int end) const {
    return static_cast<double>(std::log2(difference(coarse, exact, begin, end) / difference(fine, exact, begin, end)));
  }
};
INSTANTIATE_TEST_SUITE_P(scheme, integrators_test,
                         testing::Combine(testing::ValuesIn(schemes), testing::Values("naive", "symmetric"),
                                          testing::ValuesIn(oscillator_registry().dims())),
                         [](const auto& i) {
                           return std::get<0>(i.param).name + "_" + std::get<1>(i.param) + "_" +
                                  std::to_string(std::get<2>(i.param)) + "D";
                         });

TEST_P(integrators_test, converges_in_its_order) {
  const int steps = with.order == 1 ? 400 : with.order == 2 ? 100 : 40;
  const std::array<unknowns, 3> y{result(steps), result(2 * steps), result(4 * steps)};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(order(y[k], y[k + 1], 0, D), with.order, 0.15) << "x";
    EXPECT_NEAR(order(y[k], y[k + 1], D, 2 * D), with.order, 0.15) << "v";
    EXPECT_NEAR(order(y[k], y[k + 1], 2 * D, 2 * D + 1), with.order, 0.15) << "rho";
  }
}

TEST_P(integrators_test, particles_change_places_within_steps) {
  const run r = integrate(s, with.name, backend, 40);
  EXPECT_EQ(r.evaluations, 40 * with.evaluations);
  if (with.evaluations > 1) {
    EXPECT_GE(r.moved, 5);
  }
}

/// What would happen if the kept values did not travel with the particles: the measurement sees it.
TEST_P(integrators_test, kept_values_left_behind_are_rejected) {
  if (with.evaluations == 1) return;  // keeps none
  EXPECT_LT(order(result(100, true), result(200, true), 0, 2 * D + 1), with.order - 0.5);
}

}  // namespace
}  // namespace pairsum

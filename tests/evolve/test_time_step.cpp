#include <cmath>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/sum/registry.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/evolve/time_step.hpp"

namespace pairsum::harness {
namespace {

TEST(time_step, is_the_smaller_of_waves_and_acceleration) {
  const tait eos;
  const double H = 0.2, h = 0.1, c = eos.sound_speed0();
  EXPECT_DOUBLE_EQ(time_step({.density = eos.rho0}, H, eos, 0.5), 0.5 * h / c);
  EXPECT_DOUBLE_EQ(time_step({.speed = 3, .density = eos.rho0}, H, eos, 0.5), 0.5 * h / (c + 3));
  EXPECT_DOUBLE_EQ(time_step({.acceleration = 1e6, .density = eos.rho0}, H, eos, 0.5), 0.5 * std::sqrt(h / 1e6));
  EXPECT_LT(time_step({.density = 1.1 * eos.rho0}, H, eos, 0.5), time_step({.density = eos.rho0}, H, eos, 0.5));
}

TEST(time_step, extremes_are_those_of_the_particles_by_any_number_of_threads) {
  const initial_condition c = make_case("dam_break", {.dx = 0.1, .state = "perturbed"});
  const particle_table& p = c.particles;
  setup s = setup_of(c);
  s.backend = "symmetric_omp";
  double v2 = 0;
  std::uint32_t fastest = 0;
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    const double own = p.v[0][i] * p.v[0][i] + p.v[1][i] * p.v[1][i] + p.v[2][i] * p.v[2][i];
    if (own > v2) v2 = own, fastest = i;
  }
  for (const int threads : {1, 2, 3}) {
    const auto sum = registry::instance().make_summation(s);
    const workers w(runtime::omp, threads);
    sum->load(p, {});
    sum->evaluate(w.get());
    const extremes e = extremes_of(*sum, c.gravity, w.get());
    EXPECT_DOUBLE_EQ(e.speed, std::sqrt(v2));
    EXPECT_EQ(e.fastest, fastest);
    EXPECT_TRUE(e.finite);
    const rate_table rates = sum->rates();
    double a2 = 0;
    for (std::size_t i = 0; i < p.count(particle_kind::fluid); ++i)
      a2 = std::max(a2, std::pow(rates.columns[1][i], 2) + std::pow(rates.columns[2][i] - c.gravity, 2) +
                            std::pow(rates.columns[3][i], 2));
    EXPECT_NEAR(e.acceleration, std::sqrt(a2), 1e-12 * e.acceleration);
  }
}

}  // namespace
}  // namespace pairsum::harness

#include <cmath>

#include "harness/evolve/balance.hpp"

namespace pairsum::harness {
namespace {

particle_table two_and_a_wall() {
  particle_table p(2);
  p.resize(4);
  p.x = {{1, 3, 9, 8}, {2, 0.5, 9, 8}};
  p.v = {{2, -1, 5, 7}, {0, 4, 5, 7}};
  p.m = {3, 2, 1, 1};
  p.rho = {1000, 1010, 900, 900};
  p.kind = {particle_kind::fluid, particle_kind::fluid, particle_kind::boundary, particle_kind::lost};
  return p;
}

TEST(balance, sums_the_fluid_alone) {
  const tait eos;
  const balance b = balance_of(two_and_a_wall(), 10, eos);
  EXPECT_DOUBLE_EQ(b.kinetic, 3 * 4 / 2.0 + 2 * 17 / 2.0);
  EXPECT_DOUBLE_EQ(b.potential, 3 * 10 * 2 + 2 * 10 * 0.5);
  EXPECT_DOUBLE_EQ(b.internal, 2 * internal_energy(eos, 1010));
  EXPECT_DOUBLE_EQ(b.momentum[0], 3 * 2 - 2);
  EXPECT_DOUBLE_EQ(b.momentum[1], 8);
  EXPECT_EQ(b.low, (std::array<double, 3>{1, 0.5, 0}));
  EXPECT_EQ(b.high, (std::array<double, 3>{3, 2, 0}));
  EXPECT_DOUBLE_EQ(b.speed, std::sqrt(17.0));
  EXPECT_EQ(b.rho_low, 1000);
  EXPECT_EQ(b.rho_high, 1010);
}

TEST(balance, the_internal_energy_is_the_integral_of_p_over_rho_squared) {
  const tait eos;
  EXPECT_EQ(internal_energy(eos, eos.rho0), 0);
  for (const double rho : {900.0, 990.0, 1020.0, 1100.0}) {
    const double step = 1e-3;
    const double slope = (internal_energy(eos, rho + step) - internal_energy(eos, rho - step)) / (2 * step);
    EXPECT_NEAR(slope, eos.pressure(rho) / (rho * rho), 1e-6 * std::abs(slope)) << rho;
  }
}

}  // namespace
}  // namespace pairsum::harness

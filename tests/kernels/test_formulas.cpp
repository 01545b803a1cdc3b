#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <pairsum/core/random.hpp>
#include <pairsum/eos/tait.hpp>
#include <pairsum/interactions/ferrari09.hpp>
#include <pairsum/smoothing/wendland_c2.hpp>

// The formulas against what they are defined by, written down here a second time.
namespace pairsum {
namespace {

TEST(tait, is_its_formula) {
  const tait eos;
  EXPECT_EQ(eos.pressure(1000.0), 0);
  EXPECT_DOUBLE_EQ(eos.sound_speed0(), std::sqrt(70.0));
  for (const double rho : {900.0, 990.0, 1000.0, 1010.0, 1200.0}) {
    const double s = rho / 1000;
    EXPECT_NEAR(eos.pressure(rho), 1e4 * (std::pow(s, 7) - 1), 1e-10);
    EXPECT_DOUBLE_EQ(eos.sound_speed(rho), std::sqrt(7 * 1e4 / 1000 * std::pow(s, 6)));
    const double slope = (eos.pressure(rho + 0.01) - eos.pressure(rho - 0.01)) / 0.02;
    EXPECT_NEAR(std::pow(eos.sound_speed(rho), 2), slope, 1e-6 * slope) << "c^2 = dp/drho";
  }
  const tait other{.rho0 = 800, .B = 3e5};
  EXPECT_NEAR(other.pressure(840.0), 3e5 * (std::pow(1.05, 7) - 1), 1e-8);
}
TEST(tait, density_at_a_depth_gives_the_hydrostatic_pressure) {
  const tait eos;
  EXPECT_EQ(eos.density_at(0, 9.81), 1000);
  for (const double depth : {0.01, 0.3, 2.0}) {
    EXPECT_NEAR(eos.pressure(eos.density_at(depth, 9.81)), 1000 * 9.81 * depth, 1e-8);
    EXPECT_DOUBLE_EQ(eos.density_at(depth, 9.81), 1000 * std::pow(1000 * 9.81 * depth / 1e4 + 1, 1.0 / 7));
  }
}

/// One fluid particle, and its rates by the formula of Ferrari et al. as it stands in the
/// documentation.
struct particle {
  std::array<double, 3> x, v;
  double rho, m;
};
struct rates {
  double drho;
  std::array<double, 3> dv;
};
rates by_hand(const particle& i, const particle& j, double H) {
  const auto p = [](double rho) { return 1e4 * (std::pow(rho / 1000, 7) - 1); };
  const auto c = [](double rho) { return std::sqrt(70 * std::pow(rho / 1000, 6)); };
  double r = 0, v_dot_r = 0;
  for (int d = 0; d < 3; ++d) r += std::pow(i.x[d] - j.x[d], 2);
  r = std::sqrt(r);
  const double q = r / H, slope = -20 * 21 / (2 * std::numbers::pi * std::pow(H, 4)) * q * std::pow(1 - q, 3);
  std::array<double, 3> grad;
  for (int d = 0; d < 3; ++d) grad[d] = slope * (i.x[d] - j.x[d]) / r;
  for (int d = 0; d < 3; ++d) v_dot_r += (i.v[d] - j.v[d]) * grad[d];
  rates u;
  u.drho = j.m * (v_dot_r - std::max(c(i.rho), c(j.rho)) * slope * (j.rho - i.rho) / j.rho);
  for (int d = 0; d < 3; ++d) u.dv[d] = -j.m * (p(i.rho) / (i.rho * i.rho) + p(j.rho) / (j.rho * j.rho)) * grad[d];
  return u;
}

class ferrari09_test : public testing::Test {
 protected:
  using formula = ferrari09<3, double, wendland_c2>;
  static constexpr double H = 0.1;
  const formula f{physics{H, {}}};

  static particle random_particle(std::uint64_t n, double reach) {
    const counter_random random(9);
    const auto u = [&](std::uint64_t k, double a, double b) { return random.uniform(10 * n + k, a, b); };
    return {{u(0, 0, reach), u(1, 0, reach), u(2, 0, reach)},
            {u(3, -1, 1), u(4, -1, 1), u(5, -1, 1)},
            u(6, 950, 1050),
            u(7, 1e-4, 3e-4)};
  }
  static particle_state<3, double> state(const particle& a) {
    return {{a.x[0], a.x[1], a.x[2]}, {a.v[0], a.v[1], a.v[2]}, a.rho, a.m, 0};
  }
  static void expect_near(const formula::rates<double>& u, const rates& e) {
    const double size = std::abs(e.drho) + std::abs(e.dv[0]) + std::abs(e.dv[1]) + std::abs(e.dv[2]);
    EXPECT_GT(size, 0);
    EXPECT_NEAR(u.drho, e.drho, 1e-11 * size);
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(u.dv[d], e.dv[d], 1e-11 * size);
  }
};

TEST_F(ferrari09_test, pair_is_the_documented_formula_for_both_sides) {
  for (std::uint64_t n = 0; n < 200; ++n) {
    const particle a = random_particle(2 * n, 0.05), b = random_particle(2 * n + 1, 0.05);
    const vec<3, double> r = state(a).x - state(b).x;
    const auto u = f.pair(r, r.squaredNorm(), f.derive(state(a)), f.derive(state(b)));
    const double r2 = r.squaredNorm();
    const auto at = pair_at(f, std::sqrt(r2), r, r2, f.derive(state(a)), f.derive(state(b)));
    EXPECT_EQ(at.to_i.drho, u.to_i.drho);
    EXPECT_EQ(at.to_j.dv, u.to_j.dv);
    expect_near(u.to_i, by_hand(a, b, H));
    expect_near(u.to_j, by_hand(b, a, H));
  }
}

TEST_F(ferrari09_test, boundary_is_the_pair_with_the_mirrored_ghost) {
  for (std::uint64_t n = 0; n < 200; ++n) {
    const particle a = random_particle(2 * n, 0.02), b = random_particle(2 * n + 1, 0.02);
    particle ghost = a;
    for (int d = 0; d < 3; ++d) ghost.x[d] = 2 * b.x[d] - a.x[d], ghost.v[d] = 2 * b.v[d] - a.v[d];
    const vec<3, double> r = state(a).x - state(b).x;
    expect_near(f.boundary(r, r.squaredNorm(), f.derive(state(a)), f.derive_boundary(state(b))), by_hand(a, ghost, H));
  }
}

TEST_F(ferrari09_test, coincident_particles_exert_no_force) {
  const particle a = random_particle(1, 0.05);
  particle b = random_particle(2, 0.05);
  b.x = a.x;
  const auto u = f.pair(vec<3, double>(0, 0, 0), 0.0, f.derive(state(a)), f.derive(state(b)));
  EXPECT_EQ(u.to_i.drho, 0);
  EXPECT_EQ(u.to_i.dv.norm() + u.to_j.dv.norm(), 0);
}

}  // namespace
}  // namespace pairsum

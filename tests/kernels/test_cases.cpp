#include <gtest/gtest.h>

#include <cmath>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/error.hpp>
#include "scene.hpp"

namespace pairsum {
namespace {

using test_kit::error_of;
using test_kit::says;

initial_condition made(std::string_view name, double dx, std::string state = "rest", std::uint64_t seed = 1,
                       int dim = 3) {
  return make_case(name, {.dim = dim, .dx = dx, .state = std::move(state), .seed = seed});
}

TEST(perturb, is_reproducible_and_depends_on_the_seed) {
  const auto a = made("dam_break", 0.06, "perturbed", 5), b = made("dam_break", 0.06, "perturbed", 5);
  const auto c = made("dam_break", 0.06, "perturbed", 6);
  EXPECT_EQ(a.particles.x, b.particles.x);
  EXPECT_EQ(a.particles.v, b.particles.v);
  EXPECT_EQ(a.particles.rho, b.particles.rho);
  const std::size_t n = a.particles.count(particle_kind::fluid);
  for (std::size_t i = 0; i < n; ++i) {
    for (int d = 0; d < 3; ++d) {
      ASSERT_NE(a.particles.x[d][i], c.particles.x[d][i]);
      ASSERT_NE(a.particles.v[d][i], c.particles.v[d][i]);
    }
    ASSERT_NE(a.particles.rho[i], c.particles.rho[i]);
  }
}

/// The documented generator once more: splitmix64's output function at a counter, keyed by seed and
/// stream.
double uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
  const std::uint64_t golden = 0x9e3779b97f4a7c15u;
  const auto finalise = [](std::uint64_t z) {
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  };
  const std::uint64_t key = finalise(finalise(seed + golden) ^ stream * golden);
  return static_cast<double>(finalise(key + (counter + 1) * golden) >> 11) / 9007199254740992.0;
}

TEST(perturb, first_values_are_those_of_the_documented_generator) {
  EXPECT_EQ(uniform(1, 1, 0), 0.3607657276325963) << "computed outside this project";
  EXPECT_EQ(uniform(1, 2, 0), 0.5484083471327164);
  EXPECT_EQ(uniform(1, 3, 0), 0.648128820117275);
  const double dx = 0.06, c0 = std::sqrt(70.0);
  const auto rest = made("dam_break", dx), p = made("dam_break", dx, "perturbed");
  EXPECT_DOUBLE_EQ(p.particles.x[0][0], dx + dx * (-0.3 - 0.05 + 0.1 * 0.3607657276325963));
  EXPECT_DOUBLE_EQ(p.particles.v[0][0], 0.1 * c0 * (-1 + 2 * 0.5484083471327164));
  EXPECT_DOUBLE_EQ(p.particles.rho[0], rest.particles.rho[0] * (0.99 + 0.02 * 0.648128820117275));
  for (std::uint64_t i = 0; i < 50; ++i) {
    for (std::uint64_t d = 0; d < 3; ++d) {
      EXPECT_DOUBLE_EQ(p.particles.x[d][i], rest.particles.x[d][i] + dx * (-0.35 + 0.1 * uniform(1, 1, 3 * i + d)));
      EXPECT_NEAR(p.particles.v[d][i], 0.1 * c0 * (-1 + 2 * uniform(1, 2, 3 * i + d)), 1e-15);
    }
    EXPECT_DOUBLE_EQ(p.particles.rho[i], rest.particles.rho[i] * (0.99 + 0.02 * uniform(1, 3, i)));
  }
}

TEST(perturb, respects_its_ranges_and_leaves_the_boundary_alone) {
  const double dx = 0.03, v_max = 0.1 * std::sqrt(70.0);
  const auto rest = made("dam_break", dx), p = made("dam_break", dx, "perturbed");
  const std::size_t n = rest.particles.count(particle_kind::fluid);
  for (std::size_t i = 0; i < rest.particles.size(); ++i) {
    ASSERT_EQ(p.particles.m[i], rest.particles.m[i]);
    const double factor = p.particles.rho[i] / rest.particles.rho[i];
    for (int d = 0; d < 3; ++d) {
      const double shift = (p.particles.x[d][i] - rest.particles.x[d][i]) / dx;
      if (i >= n) {
        ASSERT_EQ(shift, 0);
        ASSERT_EQ(p.particles.v[d][i], 0);
        continue;
      }
      ASSERT_NEAR(shift, -0.3, 0.05 + 1e-12);
      ASSERT_LE(std::abs(p.particles.v[d][i]), v_max);
      ASSERT_GT(p.particles.x[d][i], 0);
    }
    ASSERT_NEAR(factor, 1, i < n ? 0.01 + 1e-12 : 0);
  }
}

TEST(cases, unknown_words_are_errors_that_list_the_valid_ones) {
  EXPECT_TRUE(says(error_of([] { made("dam_braek", 0.1); }), {"case", "dam_braek", "dam_break", "lattice"}));
  EXPECT_TRUE(says(error_of([] { made("lattice", 0.1, "resting"); }), {"state", "resting", "rest, perturbed"}));
  const auto c = made("lattice", 0.2);
  EXPECT_TRUE(
      says(error_of([&] { memory_order("hilbert", c, 1); }), {"order", "hilbert", "lattice, shuffled, morton"}));
}

TEST(cases, bad_lengths_are_refused) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const char* name : {"dam_break", "lattice"}) {
    for (const double dx : {-1.0, 0.0, std::nan(""), inf})
      EXPECT_TRUE(says(error_of([&] { made(name, dx); }), {"dx must be a positive length"})) << dx;
    for (const double H : {-1.0, std::nan(""), inf})
      EXPECT_TRUE(says(error_of([&] { make_case(name, {.dx = 0.1, .H = H}); }), {"H must be a positive"})) << H;
    EXPECT_NE(error_of([&] { made(name, 5); }), "");
    EXPECT_TRUE(says(error_of([&] { made(name, 1e-5); }), {"more than 2^32"}));
    EXPECT_TRUE(says(error_of([&] { made(name, 0.1, "rest", 1, 4); }), {"not in 4D"}));
  }
  EXPECT_TRUE(says(error_of([] { made("dam_break", 0.1, "rest", 1, 1); }), {"2D and 3D, not in 1D"}));
}

/// Counts by the documented formulas: water at spacing dx, plates at dx/1.5 (shared edges twice),
/// in 3D and 2D.
TEST(dam_break, has_the_documented_counts) {
  const auto points = [](double length, double spacing) { return std::llround(length / spacing) + 1; };
  for (const double dx : {0.1, 0.06, 0.0231}) {
    const long long water = points(0.6 - 2 * dx, dx), x = points(3.25, dx / 1.5), y = points(1.8, dx / 1.5),
                    z = points(0.6, dx / 1.5);
    const auto c = made("dam_break", dx), flat = made("dam_break", dx, "rest", 1, 2);
    EXPECT_EQ(c.particles.count(particle_kind::fluid), water * water * water);
    EXPECT_EQ(c.particles.count(particle_kind::boundary), 2 * x * y + 2 * z * y + x * z);
    EXPECT_EQ(flat.particles.count(particle_kind::fluid), water * water);
    EXPECT_EQ(flat.particles.count(particle_kind::boundary), 2 * y + x);
    EXPECT_EQ(flat.particles.dim, 2);
    EXPECT_EQ(c.H, 2 * dx);
    double mass = 0;
    for (std::size_t i = 0; i < c.particles.size(); ++i)
      if (c.particles.kind[i] == particle_kind::fluid) mass += c.particles.m[i];
    EXPECT_NEAR(mass, 1000 * std::pow(0.6 - 2 * dx, 3), 1e-9);
    EXPECT_EQ(c.omega_high, (std::vector<double>{3.3, 1.8, 0.61}));
  }
}

TEST(dam_break, water_is_at_rest_hydrostatic_and_inside) {
  const auto c = made("dam_break", 0.05);
  for (std::size_t i = 0; i < c.particles.count(particle_kind::fluid); ++i) {
    const double depth = 0.55 - c.particles.x[1][i];
    ASSERT_NEAR(c.eos.pressure(c.particles.rho[i]), 1000 * 9.81 * depth, 1e-7);
    for (int d = 0; d < 3; ++d) {
      ASSERT_EQ(c.particles.v[d][i], 0);
      ASSERT_GE(c.particles.x[d][i], 0.05);
      ASSERT_LE(c.particles.x[d][i], 0.55 + 1e-15);
    }
  }
}

TEST(lattice, fills_the_unit_cube_in_every_dimension) {
  for (const int dim : {1, 2, 3}) {
    const auto c = made("lattice", 0.1, "rest", 1, dim);
    EXPECT_EQ(c.particles.size(), std::pow(10, dim));
    EXPECT_EQ(c.particles.count(particle_kind::boundary), 0u);
    EXPECT_EQ(c.particles.x[0][3], 0.35);
    EXPECT_DOUBLE_EQ(c.particles.m[0] * static_cast<double>(c.particles.size()), 1000);
    EXPECT_EQ(c.omega_high, std::vector<double>(static_cast<std::size_t>(dim), 1));
  }
}

TEST(periodic_lattice, is_the_lattice_in_a_periodic_box) {
  for (const int dim : {1, 2, 3}) {
    const auto c = made("periodic_lattice", 0.0625, "rest", 1, dim), open = made("lattice", 0.0625, "rest", 1, dim);
    EXPECT_EQ(c.particles.x, open.particles.x);
    EXPECT_EQ(c.periodic, axes::all(dim));
    EXPECT_FALSE(open.periodic.any());
    EXPECT_EQ(c.H, 0.125);
    const auto moved = made("periodic_lattice", 0.0625, "perturbed", 1, dim);
    for (const auto& x : moved.particles.x)
      for (const double a : x) ASSERT_TRUE(a >= 0 && a < 1);
  }
  EXPECT_TRUE(says(error_of([] { made("periodic_lattice", 0.17); }), {"periodic_lattice", "1/3 m", "is 0.34"}));
  initial_condition c = made("periodic_lattice", 0.125);
  for (auto& x : c.particles.x) std::ranges::fill(x, 0.01);
  perturb(c, 0.125, 1);  // who leaves comes back
  for (const auto& x : c.particles.x)
    for (const double a : x) ASSERT_TRUE(a >= 0.9 && a < 1) << a;
}

}  // namespace
}  // namespace pairsum

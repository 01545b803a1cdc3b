#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene.hpp"

namespace pairsum {
namespace {

using namespace test_kit;

initial_condition made(const char* name, double dx, int dim, std::uint64_t seed = 1, const char* state = "rest") {
  return make_case(name, {.dim = dim, .dx = dx, .H = 0, .state = state, .seed = seed});
}

/// Neighbours of each particle within H, by the double loop.
std::vector<int> neighbours(const initial_condition& c) {
  const particle_table& p = c.particles;
  std::vector<int> n(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double r2 = 0;
      for (const auto& x : p.x) r2 += (x[i] - x[j]) * (x[i] - x[j]);
      if (r2 < c.H * c.H) ++n[i], ++n[j];
    }
  return n;
}

struct moments {
  double mean = 0, variance = 0;
};
moments moments_of(const std::vector<int>& n) {
  moments m;
  for (const int a : n) m.mean += a;
  m.mean /= static_cast<double>(n.size());
  for (const int a : n) m.variance += (a - m.mean) * (a - m.mean);
  m.variance /= static_cast<double>(n.size());
  return m;
}

class random_cases_test : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(name, random_cases_test, testing::Values("random_uniform", "random_clustered"),
                         [](const auto& i) { return i.param; });

TEST_P(random_cases_test, hold_the_documented_particles_in_every_dimension) {
  for (const int dim : {1, 2, 3})
    for (const char* state : {"rest", "perturbed"}) {
      const double dx = dim == 1 ? 0.001 : dim == 2 ? 0.03 : 0.09;
      const auto c = made(GetParam(), dx, dim, 1, state);
      EXPECT_EQ(c.particles.size(), static_cast<std::size_t>(std::round(std::pow(dx, -dim))));
      EXPECT_EQ(c.particles.count(particle_kind::boundary), 0u);
      EXPECT_EQ(c.H, 2 * dx);
      EXPECT_DOUBLE_EQ(c.particles.m[0] * static_cast<double>(c.particles.size()), 1000);
      for (const auto& x : c.particles.x)
        for (const double a : x) ASSERT_TRUE(a >= 0 && a <= 1) << state;
    }
}

TEST_P(random_cases_test, the_seed_alone_decides) {
  EXPECT_EQ(made(GetParam(), 0.1, 3).particles.x, made(GetParam(), 0.1, 3).particles.x);
  EXPECT_NE(made(GetParam(), 0.1, 3).particles.x, made(GetParam(), 0.1, 3, 2).particles.x);
}

/// "lattice" means the same memory order as elsewhere: along the cells of width dx, x fastest.
TEST_P(random_cases_test, ids_follow_the_cells) {
  const double dx = 0.05;
  const auto c = made(GetParam(), dx, 3);
  const auto cell = [&](std::size_t i) {
    std::array<int, 3> at;
    for (int d = 0; d < 3; ++d) at[2 - d] = static_cast<int>((c.particles.x[d][i] - dx / 2) / (1 - dx) / dx);
    return at;
  };
  std::size_t falling = 0;
  for (std::size_t i = 1; i < c.particles.size(); ++i) falling += cell(i) < cell(i - 1);
  EXPECT_LE(falling, 2u) << "but for rounding at the faces of cells";
}

TEST_P(random_cases_test, refuse_what_they_cannot_be) {
  EXPECT_TRUE(says(error_of([] { made(GetParam(), 5, 3); }), {GetParam(), "dx <= 1"}));
  EXPECT_TRUE(says(error_of([] { made(GetParam(), 1e-5, 3); }), {GetParam(), "more than 2^32"}));
  EXPECT_TRUE(says(error_of([] { made(GetParam(), 0.1, 4); }), {"not in 4D"}));
  EXPECT_TRUE(says(error_of([] { made(GetParam(), -1, 2); }), {"dx must be a positive length"}));
}

TEST(random_uniform, has_the_neighbours_of_a_poisson_process) {
  const auto c = made("random_uniform", 0.04, 2);  // 625 particles, a quarter of them near a face
  const moments m = moments_of(neighbours(c));
  const double inside = 625 * std::numbers::pi * c.H * c.H;  // 12.6, less at the faces
  EXPECT_GT(m.mean, 0.8 * inside);
  EXPECT_LT(m.mean, 1.1 * inside);
  EXPECT_GT(m.variance, 0.5 * m.mean) << "a lattice has next to none";
  EXPECT_LT(m.variance, 2.5 * m.mean);
  const auto lattice = make_case("lattice", {.dim = 2, .dx = 0.04});
  EXPECT_LT(moments_of(neighbours(lattice)).variance, 0.4 * m.variance);
}

TEST(random_clustered, is_denser_where_it_is_and_empty_elsewhere) {
  for (const int dim : {2, 3}) {
    const double dx = dim == 2 ? 0.02 : 0.08;
    const moments uniform = moments_of(neighbours(made("random_uniform", dx, dim)));
    const moments clustered = moments_of(neighbours(made("random_clustered", dx, dim)));
    EXPECT_GT(clustered.mean, 3 * uniform.mean) << dim << "D";
    EXPECT_LT(clustered.mean, 16 * uniform.mean) << dim << "D";
  }
}

}  // namespace
}  // namespace pairsum

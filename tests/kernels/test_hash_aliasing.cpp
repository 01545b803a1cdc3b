#include <gtest/gtest.h>

#include "cloud.hpp"

// Many cells fold onto one: far particles share a cell, and only the distance test tells them
// apart.
namespace pairsum {
namespace {

using namespace test_kit;

class hash_aliasing_test : public testing::TestWithParam<std::string> {
 protected:
  void expect_agreement(const scene& s, std::uint64_t at_least) const {
    for (const char* interaction : {"ferrari09", "count"}) {
      const setup world = with(s.world, GetParam(), 2, interaction);
      const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
      EXPECT_GE(expected.pairs_fluid_fluid, at_least);
      EXPECT_EQ(disagreement(evaluated(world, s.particles, 3)->rates(), expected), "") << interaction;
    }
  }
};
INSTANTIATE_TEST_SUITE_P(backend, hash_aliasing_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

/// Clusters 4 H apart, in a box 200 H long: with M = 2 every cluster lands on the same few cells.
TEST_P(hash_aliasing_test, row_of_clusters_on_the_same_cells) {
  scene s;
  const double H = s.world.constants.H = 0.1;
  s.world.omega_low = {-3, 0, 0};
  s.world.omega_high = {-3 + 200 * H, 1, 1};
  const counter_random random(1);
  const std::uint32_t n = 600;
  s.particles.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t cluster = i % 50;
    for (std::uint32_t d = 0; d < 3; ++d) {
      s.particles.x[d][i] = (d == 0 ? -3 + 4 * H * cluster : 0.2) + H * random.uniform(3 * i + d);
      s.particles.v[d][i] = random.uniform(3 * i + d + 10000, -1, 1);
    }
    s.particles.rho[i] = 1000 + i % 7;
    s.particles.m[i] = 1e-3 * (1 + i % 3);
    s.particles.kind[i] = i < 500 ? particle_kind::fluid : particle_kind::boundary;
  }
  expect_agreement(s, 1000);
  const auto sum = evaluated(with(s.world, GetParam(), 2), s.particles);
  EXPECT_LE(sum->count_work().cells_nonempty, 64u);
  if (sum->traits().skin > 0) return;  // what is tested was listed
  EXPECT_GT(sum->count_work().pairs_tested, 10 * sum->count_work().pairs_interacting()) << "far clusters share cells";
}

TEST_P(hash_aliasing_test, uniform_cloud_many_tori_long) {
  cloud c;
  c.fluid = 1200;
  c.boundary = 400;
  c.length = 13;  // 3.25 tori per axis, so folds do not line up
  c.corner = -0.3;
  expect_agreement(make_cloud(c), 1000);
}

}  // namespace
}  // namespace pairsum

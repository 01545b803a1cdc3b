#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "broken_backends.hpp"
#include "interactions/ferrari09.hpp"
#include "scene.hpp"
#include "smoothing/wendland_c2.hpp"

// Fluid pairs conserve momentum: the sum of m dv over the fluid is zero but for rounding.
namespace pairsum {
namespace {

using namespace test_kit;

struct momentum {
  long double rate = 0, bound = 0;
};

/// Component d of the sum of m dv, and how far rounding may take it from 0: each rate lies within
/// its expectation's bound of the exact rate, the exact m dv cancel, and this sum itself rounds n
/// additions and products of |m dv|.
momentum momentum_rate(const particle_table& p, const rate_table& rates, const expectation& e, std::size_t d) {
  momentum sum;
  long double size = 0;
  for (std::size_t k = 0; k < e.ids.size(); ++k) {
    const long double m = p.m[e.ids[k]], dv = rates.columns[1 + d][e.ids[k]];
    sum.rate += m * dv;
    sum.bound += m * e.bound[1 + d][k];
    size += std::abs(m * dv);
  }
  sum.bound += static_cast<long double>(e.ids.size()) * std::numeric_limits<long double>::epsilon() * size;
  return sum;
}

scene uneven_lattice() {
  scene s = make_scene("lattice", 0.1, "perturbed");
  for (std::size_t i = 0; i < s.particles.size(); ++i) s.particles.m[i] *= 1 + 0.1 * (i % 5);
  return s;
}

expectation expected(const scene& s) {
  return registry::instance().make_reference(with(s.world, "naive", 4))->brute_force(s.particles, some_threads());
}

class momentum_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(backend, momentum_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

TEST_P(momentum_test, of_fluid_alone_is_conserved) {
  const scene s = uneven_lattice();
  const expectation e = expected(s);
  const auto rates = evaluated(with(s.world, GetParam(), 4), s.particles, 3)->rates();
  for (std::size_t d = 0; d < 3; ++d) {
    const momentum p = momentum_rate(s.particles, rates, e, d);
    EXPECT_LE(std::abs(p.rate), p.bound) << "component " << d;
    EXPECT_GT(p.bound, 0);
  }
}

TEST(momentum, check_rejects_one_sided_pairs) {
  const scene s = uneven_lattice();
  const expectation e = expected(s);
  using formula = ferrari09<3, double, wendland_c2>;
  summation_of<broken_symmetric<fault::flip_sign>, formula> sum(with(s.world, "", 4));
  sum.load(s.particles, {});
  sum.evaluate(team());
  const momentum p = momentum_rate(s.particles, sum.rates(), e, 0);
  EXPECT_GT(std::abs(p.rate), p.bound);
}

/// Boundary particles push fluid and are not pushed: no rates, no motion; fluid out of their reach
/// does not feel them.
TEST_P(momentum_test, boundary_acts_on_fluid_alone) {
  const scene s = make_scene("dam_break", 0.06, "perturbed");
  scene fluid_only = s;
  const std::size_t n = s.particles.count(particle_kind::fluid);
  fluid_only.particles.resize(n);
  // Bits are compared, which of some backends are chance on several threads.
  const int threads = registry::instance().find_backend(GetParam()).traits.deterministic ? 2 : 1;
  const auto with_walls = evaluated(with(s.world, GetParam(), 4), s.particles, threads)->rates();
  const auto without = evaluated(with(s.world, GetParam(), 4), fluid_only.particles, threads)->rates();
  const double reach = s.world.constants.H / 2;
  std::size_t near = 0, far = 0;
  for (std::size_t i = 0; i < n; ++i) {
    bool touched = false;
    for (std::size_t b = n; b < s.particles.size() && !touched; ++b)
      touched = std::hypot(s.particles.x[0][i] - s.particles.x[0][b], s.particles.x[1][i] - s.particles.x[1][b],
                           s.particles.x[2][i] - s.particles.x[2][b]) < reach;
    bool changed = false;
    for (std::size_t c = 0; c < 4; ++c) changed |= with_walls.columns[c][i] != without.columns[c][i];
    EXPECT_TRUE(touched || !changed) << "particle " << i << " is out of reach";
    near += touched && changed;
    far += !touched;
  }
  EXPECT_GT(near, 50u);
  EXPECT_GT(far, 50u);
  for (const auto& column : with_walls.columns)
    for (std::size_t b = n; b < s.particles.size(); ++b) ASSERT_EQ(column[b], 0);
}

}  // namespace
}  // namespace pairsum

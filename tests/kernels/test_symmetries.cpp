#include <gtest/gtest.h>

#include <cmath>

#include "any_cloud.hpp"

// What must not depend on how a state is written down: the order of the particles, where the origin lies, left and
// right; and the momentum of fluid pairs. Positions are multiples of 2^-10 H with H a power of two, so that moved and
// mirrored differences have the very same bits, and all that may differ is the rounding of the sums.
namespace pairsum {
namespace {

using namespace test_kit;

constexpr double H = 0.125, step = H / 1024;

scene dyadic_cloud(cloud c) {
  c.H = H;
  c.length = 8;
  c.corner = -0.5;
  c.fluid += 20;
  scene s = make_cloud(c);
  for (auto& x : s.particles.x)
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = std::round(x[i] / step) * step;
      // Boundary particles half a step off, so that none lies on a fluid particle.
      if (s.particles.kind[i] == particle_kind::boundary) x[i] += (x[i] > 0 ? -0.5 : 0.5) * step;
    }
  return s;
}

class symmetries_test : public testing::TestWithParam<std::string> {
 protected:
  template <class Property>
  static void holds(Property property) {
    EXPECT_TRUE(rc::check(GetParam(), [&](cloud c) {
      const formula_choice f = *some_formula(GetParam(), *rc::gen::inRange(0, 5) == 0);
      c.dim = f.dim;
      const scene s = dyadic_cloud(c);
      const auto oracle = registry::instance().make_reference(with(s.world, f));
      property(f, c, s, oracle->brute_force(s.particles, team()));
    }));
  }
  static rate_table rates(const scene& s, const formula_choice& f, const grid_choice& grid,
                          const std::vector<std::uint32_t>& order = {}) {
    setup world = with(s.world, f, GetParam(), grid);
    world.isa = *rc::gen::elementOf(isas_for(f, GetParam()));
    const auto sum = registry::instance().make_summation(world);
    workers w(sum->traits().threads, 1);
    sum->load(s.particles, order);
    sum->evaluate(w.get());
    return sum->rates();
  }
};
INSTANTIATE_TEST_SUITE_P(backend, symmetries_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

TEST_P(symmetries_test, order_of_the_input_changes_nothing_but_rounding) {
  holds([](const formula_choice& f, const cloud& c, const scene& s, const expectation& e) {
    RC_ASSERT(disagreement(rates(s, f, c.choice(), shuffled(s.particles.size(), c.seed)), e) == "");
    RC_ASSERT(disagreement(rates(s, f, c.choice(), shuffled(s.particles.size(), c.seed + 1)), e) == "");
  });
}

TEST_P(symmetries_test, moving_everything_by_cells_changes_nothing_but_rounding) {
  holds([](const formula_choice& f, const cloud& c, const scene& s, const expectation& e) {
    scene moved = s;
    for (int d = 0; d < c.dim; ++d) {
      const double by = static_cast<double>(*rc::gen::inRange(-8, 9)) * H;
      for (double& a : moved.particles.x[d]) a += by;
    }
    moved.world.omega_low.assign(c.dim, -2);  // Omega stays where it is, so the cells under the particles are others
    moved.world.omega_high.assign(c.dim, 2);
    RC_ASSERT(disagreement(rates(moved, f, c.choice()), e) == "");
  });
}

TEST_P(symmetries_test, a_mirror_turns_one_component_round) {
  holds([](const formula_choice& f, const cloud& c, const scene& s, const expectation& e) {
    const int axis = *rc::gen::inRange(0, c.dim);
    scene mirrored = s;
    for (double& a : mirrored.particles.x[axis]) a = -a;
    for (double& a : mirrored.particles.v[axis]) a = -a;
    rate_table u = rates(mirrored, f, c.choice());
    if (f.interaction != "count")
      for (double& a : u.columns[1 + axis]) a = -a;
    RC_ASSERT(disagreement(u, e) == "");
  });
}

TEST_P(symmetries_test, fluid_pairs_conserve_momentum) {
  EXPECT_TRUE(rc::check(GetParam(), [&](cloud c) {
    c.boundary = 0;
    const formula_choice f = *some_formula(GetParam(), false);
    c.dim = f.dim;
    const scene s = dyadic_cloud(c);
    const expectation e = registry::instance().make_reference(with(s.world, f))->brute_force(s.particles, team());
    const rate_table u = rates(s, f, c.choice());
    const double mass_rounding = f.precision == "double" ? 2e-16 : 1e-7;  // the particles' masses are rounded, too
    for (int d = 0; d < c.dim; ++d) {
      long double rate = 0, bound = 0;
      for (std::size_t k = 0; k < e.ids.size(); ++k) {
        const long double m = s.particles.m[e.ids[k]];
        rate += m * u.columns[1 + d][e.ids[k]];
        bound += m * (e.bound[1 + d][k] + mass_rounding * e.magnitude[1 + d][k]);
      }
      RC_ASSERT(std::isfinite(bound));
      RC_ASSERT(std::abs(rate) <= bound);
      // The check bites: without one particle the momentum is off, unless nothing pushes it.
      const std::size_t one = e.ids.size() / 2;
      const long double part = static_cast<long double>(s.particles.m[e.ids[one]]) * u.columns[1 + d][e.ids[one]];
      RC_CLASSIFY(std::abs(rate - part) > bound, "a missing particle would be seen");
    }
  }));
}

/// Boundary particles push fluid and are not pushed: no rates, no motion; fluid out of their reach does not feel them.
TEST_P(symmetries_test, boundary_acts_on_fluid_alone) {
  const scene s = make_scene("dam_break", 0.06, "perturbed");
  particle_table fluid_only = s.particles;
  const std::size_t n = s.particles.count(particle_kind::fluid);
  fluid_only.resize(n);
  // Bits are compared, which of some backends are chance on several threads.
  const int threads = registry::instance().find_backend(GetParam()).traits.deterministic ? 2 : 1;
  const auto with_walls = evaluated(with(s.world, GetParam(), 4), s.particles, threads)->rates();
  const auto without = evaluated(with(s.world, GetParam(), 4), fluid_only, threads)->rates();
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

/// The comparisons above can fail: a state moved by a part of a step is another state.
TEST(symmetries, the_comparison_rejects_another_state) {
  cloud c;
  c.fluid = 150;
  scene s = dyadic_cloud(c);
  const formula_choice f{3, "double", "ferrari09", "wendland_c2"};
  const expectation e = registry::instance().make_reference(with(s.world, f))->brute_force(s.particles, team());
  ASSERT_EQ(disagreement(evaluated(with(s.world, f, "symmetric", 3), s.particles)->rates(), e), "");
  s.particles.x[0][7] += 1e-9;
  EXPECT_NE(disagreement(evaluated(with(s.world, f, "symmetric", 3), s.particles)->rates(), e), "");
  s.particles.x[0][7] -= 1e-9;
  rate_table u = evaluated(with(s.world, f, "symmetric", 3), s.particles)->rates();
  std::swap(u.columns[1][3], u.columns[1][4]);
  EXPECT_NE(disagreement(u, e), "");
}

}  // namespace
}  // namespace pairsum

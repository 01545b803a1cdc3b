#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scene.hpp"

// Every backend, scalar and on every instruction set, with the talk's formula and with `count`, against brute force.
namespace pairsum {
namespace {

using namespace test_kit;

class backends_test : public testing::TestWithParam<std::string> {
 protected:
  const backend_traits& traits = registry::instance().find_backend(GetParam()).traits;

  /// Calls f(setup, what is expected) for both formulas and everything that this backend sums on.
  template <class F>
  void each(const scene& s, const std::string& of, F&& f) const {
    static std::map<std::string, expectation> known;
    for (formula_choice formula : two_formulas) {
      formula.dim = s.world.dim;
      setup world = with(s.world, formula, GetParam(), {s.world.grid, s.world.M});
      expectation& e = known[of + formula.interaction];
      if (e.ids.empty()) e = registry::instance().make_reference(world)->brute_force(s.particles, some_threads());
      for (const std::string& isa : isas_for(formula, GetParam())) {
        world.isa = isa;
        SCOPED_TRACE(of + " " + formula.interaction + " " + isa);
        f(world, e);
      }
    }
  }
  void expect_agreement(const scene& s, const std::string& of) const {
    each(s, of, [&](const setup& world, const expectation& e) {
      EXPECT_EQ(disagreement(evaluated(world, s.particles, 3)->rates(), e), "");
    });
  }
};
INSTANTIATE_TEST_SUITE_P(backend, backends_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

const scene& perturbed() {
  static const scene s = make_scene("dam_break", 0.055, "perturbed");
  return s;
}

/// On every grid and team; and the same bits, if that is what it claims.
TEST_P(backends_test, is_within_the_bound_on_every_grid_and_team) {
  each(perturbed(), "dam_break", [&](setup world, const expectation& e) {
    for (const grid_choice& grid : every_grid({2, 5})) {
      world.grid = grid.name;
      world.M = grid.M;
      const auto sum = registry::instance().make_summation(world);
      std::uint64_t bits = 0;
      for (const int threads : {1, 2, 7}) {
        const workers w(traits.threads, threads);
        sum->load(perturbed().particles, {});
        sum->evaluate(w.get());
        ASSERT_EQ(disagreement(sum->rates(), e), "") << grid << " threads=" << threads;
        if (threads == 1) bits = sum->fingerprint();
        if (traits.deterministic) {
          ASSERT_EQ(sum->fingerprint(), bits) << grid << " threads=" << threads;
        }
      }
      const work_counts n = sum->count_work();
      ASSERT_EQ(n.pairs_fluid_fluid, e.pairs_fluid_fluid) << grid;
      EXPECT_EQ(sum->isa(), world.isa);
    }
  });
}

TEST_P(backends_test, is_within_the_bound_in_one_and_two_dimensions) {
  for (const int dim : {1, 2})
    for (const char* name : {"lattice", "periodic_lattice", "random_clustered"})
      expect_agreement(make_scene_in(dim, name, dim == 1 ? 1.0 / 1000 : 1.0 / 33, "perturbed"),
                       name + std::to_string(dim));
}

TEST_P(backends_test, is_within_the_bound_through_the_faces_of_a_box_and_in_clusters) {
  expect_agreement(make_scene_in(3, "periodic_lattice", 1.0 / 11, "perturbed"), "periodic_lattice");
  expect_agreement(make_scene_in(3, "random_clustered", 0.08, "perturbed"), "random_clustered");
}

TEST_P(backends_test, is_within_the_bound_where_lists_are_full) { expect_agreement(crowded_cell(), "crowded_cell"); }

TEST(backends, lists_of_the_crowded_cell_are_full) {
  const scene s = crowded_cell();
  const auto in_reach = [&](std::size_t i, particle_kind kind, double reach) {
    std::size_t n = 0;
    for (std::size_t j = 0; j < s.particles.size(); ++j) {
      double square = 0;
      for (const auto& x : s.particles.x) square += (x[i] - x[j]) * (x[i] - x[j]);
      n += j != i && s.particles.kind[j] == kind && square < reach * reach;
    }
    return n;
  };
  const double H = s.world.constants.H;
  EXPECT_GT(in_reach(0, particle_kind::fluid, H), 2048u);
  EXPECT_GT(in_reach(0, particle_kind::fluid, H) + in_reach(0, particle_kind::boundary, H / 2), 6144u);
  EXPECT_EQ(in_reach(100, particle_kind::boundary, H / 2), 0u) << "few are enough";
}

TEST_P(backends_test, order_of_memory_does_not_matter) {
  initial_condition c;
  c.particles = perturbed().particles;
  c.omega_low = perturbed().world.omega_low;
  c.H = perturbed().world.constants.H;
  each(perturbed(), "dam_break", [&](const setup& world, const expectation& e) {
    const auto sum = registry::instance().make_summation(world);
    const workers w(traits.threads, 2);
    for (const auto name : memory_orders) {
      sum->load(c.particles, memory_order(name, c, 3));
      sum->evaluate(w.get());
      EXPECT_EQ(disagreement(sum->rates(), e), "") << name;
    }
  });
}

/// One schedule on several runtimes: the same pairs in the same order.
TEST_P(backends_test, the_same_schedule_on_another_runtime_has_the_same_bits) {
  const auto& all = registry::instance().backends();
  const auto twin = std::ranges::find(all, traits.description, [](const auto& b) { return b.traits.description; });
  if (twin->traits.name == GetParam()) {
    ASSERT_FALSE(GetParam().ends_with("_tbb")) << "what runs on oneTBB runs on OpenMP, too";
    GTEST_SKIP() << "the first of its schedule";
  }
  each(perturbed(), "dam_break", [&](setup world, const expectation&) {
    const auto bits = evaluated(world, perturbed().particles, 3)->fingerprint();
    world.backend = twin->traits.name;
    EXPECT_EQ(evaluated(world, perturbed().particles, 3)->fingerprint(), bits) << world.backend;
  });
}

TEST(backends, the_state_is_alive) {
  const scene& s = perturbed();
  EXPECT_EQ(s.particles.count(particle_kind::fluid), 1000u);
  const expectation e =
      registry::instance().make_reference(with(s.world, "naive", 4))->brute_force(s.particles, some_threads());
  EXPECT_GT(e.pairs_fluid_boundary, 1000u);
  for (std::size_t c = 0; c < e.value.size(); ++c)
    for (std::size_t k = 0; k < e.ids.size(); ++k) {
      EXPECT_NE(e.value[c][k], 0);
      EXPECT_LT(e.bound[c][k], 1e-12 * e.magnitude[c][k]) << "the bound would let anything pass";
    }
}

TEST(disagreement, rejects) {
  const setup world = with(perturbed().world, "symmetric", 4);
  const expectation e = registry::instance().make_reference(world)->brute_force(perturbed().particles, some_threads());
  const rate_table good = evaluated(world, perturbed().particles)->rates();
  ASSERT_EQ(disagreement(good, e), "");
  rate_table bad = good;
  bad.columns[2][500] += 3 * e.bound[2][500];
  EXPECT_TRUE(says(disagreement(bad, e), {"dv_y of particle 500 is"})) << disagreement(bad, e);
  bad = good;
  bad.columns[0][999] = std::nan("");
  EXPECT_TRUE(says(disagreement(bad, e), {"drho of particle 999 is nan"}));
  bad = good;
  bad.columns[1][1500] = 1e-300;  // a boundary particle
  EXPECT_TRUE(says(disagreement(bad, e), {"dv_x of particle 1500 is", "not 0"}));
  expectation anything = e;
  anything.bound[1][7] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(says(disagreement(good, anything), {"dv_x of particle 7 is"})) << "an infinite bound bounds nothing";
  bad = good;
  bad.names[1] = "dv";
  EXPECT_EQ(disagreement(bad, e), "other columns");
}

}  // namespace
}  // namespace pairsum

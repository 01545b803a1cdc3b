#include <gtest/gtest.h>

#include <cmath>

#include <pairsum/integrators/integrator.hpp>
#include <pairsum/integrators/with_state.hpp>
#include "scene.hpp"

// Particles that leave Omega, or become NaN, during stepping: flagged, counted, no longer summed.
namespace pairsum {
namespace {

using namespace test_kit;

class lost_test : public testing::TestWithParam<backend_on_grid> {
 protected:
  scene s = make_scene("dam_break", 0.08, "perturbed");
  setup world = with(s.world, std::get<0>(GetParam()), std::get<1>(GetParam()));

  /// Sets component d of the position of the particle with this id, as a step would.
  static void place(summation& sum, std::uint32_t id, int d, double x) {
    with_state(sum, [&]<int D, class R>(state<D, R>& st) {
      auto& p = st.particles();
      for (std::size_t i = 0; i < p.size(); ++i)
        if (p.id[i] == id) p.x[d][i] = static_cast<R>(x);
    });
  }
};
INSTANTIATE_TEST_SUITE_P(every, lost_test,
                         testing::Combine(testing::ValuesIn(backend_names()), testing::ValuesIn(every_grid({4}))),
                         name_of_test);

TEST_P(lost_test, are_flagged_counted_and_not_summed) {
  const auto sum = evaluated(world, s.particles, 2);
  EXPECT_EQ(sum->lost(), 0u);
  workers w(sum->traits().threads, 2);
  const std::uint32_t fluid = static_cast<std::uint32_t>(s.particles.count(particle_kind::fluid));
  place(*sum, 3, 1, std::nan(""));
  place(*sum, 40, 0, std::nextafter(world.omega_low[0], -1.0));
  place(*sum, fluid - 1, 2, std::numeric_limits<double>::infinity());
  sum->evaluate(w.get());
  EXPECT_EQ(sum->lost(), 3u);
  place(*sum, 41, 1, 1e300);
  sum->evaluate(w.get());
  EXPECT_EQ(sum->lost(), 4u) << "counts since load()";

  const particle_table now = sum->snapshot();
  const auto rates = sum->rates();
  for (const std::uint32_t id : {3u, 40u, 41u, fluid - 1}) {
    EXPECT_EQ(now.kind[id], particle_kind::lost);
    for (const auto& column : rates.columns) EXPECT_EQ(column[id], 0) << "particle " << id;
  }
  EXPECT_EQ(now.count(particle_kind::fluid), fluid - 4u);
  // The rest sums as if those four did not exist, bounds and all.
  const auto expected = registry::instance().make_reference(world)->brute_force(now, some_threads());
  EXPECT_EQ(expected.ids.size(), fluid - 4u);
  EXPECT_EQ(disagreement(rates, expected), "");

  sum->load(s.particles, {});
  EXPECT_EQ(sum->lost(), 0u) << "load() starts anew";
}

TEST_P(lost_test, a_particle_on_the_face_of_omega_is_inside) {
  const auto sum = evaluated(world, s.particles, 2);
  workers w(sum->traits().threads, 2);
  place(*sum, 7, 0, world.omega_high[0]);
  place(*sum, 8, 1, world.omega_low[1]);
  sum->evaluate(w.get());
  EXPECT_EQ(sum->lost(), 0u);
}

TEST_P(lost_test, lost_particles_are_not_moved) {
  const auto sum = evaluated(world, s.particles, 2);
  workers w(sum->traits().threads, 2);
  place(*sum, 5, 1, -0.5);
  find_integrator("euler").step(
      *sum, 1e-5, 9.81, [&] { sum->evaluate(w.get()); }, w.get());
  const particle_table now = sum->snapshot();
  EXPECT_EQ(now.x[1][5], -0.5);
  EXPECT_EQ(now.v[1][5], s.particles.v[1][5]);
  EXPECT_EQ(now.rho[5], s.particles.rho[5]);
  EXPECT_NE(now.v[1][6], s.particles.v[1][6]);
}

}  // namespace
}  // namespace pairsum

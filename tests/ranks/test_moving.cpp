#include <gtest/gtest.h>

#include <cmath>

#include <pairsum/integrators/integrator.hpp>

#include "ranked_scene.hpp"

// Particles that move through the borders of ranks.
namespace pairsum {
namespace {

using namespace test_kit;

/// What was summed may be loaded again, as a simulation does for its checkpoints.
TEST(moving, a_second_load_sums_as_the_first) {
  const scene s = make_scene_in(3, "dam_break", 0.08, "perturbed");
  const setup world = with(s.world, "symmetric_omp", {"compact_grid", 0});
  const auto oracle = registry::instance().make_reference(world);
  auto sum = ranked(world, {.skin = 0.1});
  const workers w(sum->traits().threads, 1);
  sum->load(s.particles, {});
  for (int load = 0; load < 2; ++load) {
    for (int k = 0; k < 2; ++k) sum->evaluate(w.get());
    EXPECT_EQ(disagreement(sum->rates(), oracle->brute_force(s.particles, some_threads())), "") << "load " << load;
    sum->load(sum->snapshot(), {});
  }
}

/// 40 steps with a new partition every 5: nobody is lost, rates stay within the bound of the state that they belong
/// to, and states within rounding of those that one rank reaches.
TEST(moving, forty_steps_with_a_partition_every_five) {
  for (const char* name : {"periodic_lattice", "dam_break", "dam_break_that_leaks"})
    for (const char* integrator : {"euler", "rk2"})
      for (const char* backend : {"symmetric_omp", "verlet_list", "tiles_omp"}) {
        SCOPED_TRACE(testing::Message() << name << " " << integrator << " " << backend);
        const bool periodic = std::string(name) == "periodic_lattice";
        const bool leaves = std::string(name) == "dam_break_that_leaks";  // steps are too large
        const scene s = make_scene_in(3, periodic ? name : "dam_break", periodic ? 1.0 / 10 : 0.08, "perturbed");
        const setup world = with(s.world, backend, {"compact_grid", 0});
        const auto oracle = registry::instance().make_reference(world);
        auto alone = registry::instance().make_summation(world);
        auto sum =
            ranked(world, {.pairs = cut_pairs::once, .partition_every = std::string(integrator) == "rk2" ? 10 : 5});
        const workers w(sum->traits().threads, 2);
        alone->load(s.particles, {});
        sum->load(s.particles, {});
        const double dt = leaves ? 1e-2 : periodic ? 2e-3 : 1e-3;
        std::uint64_t moved = 0;
        for (int step = 0; step < 40; ++step) {
          const auto& scheme = find_integrator(integrator);
          scheme.step(
              *alone, dt, 0, [&] { alone->evaluate(w.get()); }, w.get());
          bool first = true;
          scheme.step(
              *sum, dt, 0,
              [&] {
                const bool look = first && step % 8 == 7;
                first = false;
                sum->evaluate(w.get());
                for (const auto& f : ranks::facts_of(*sum)) moved += f.migrate.messages;
                if (look) {
                  EXPECT_EQ(disagreement(sum->rates(), oracle->brute_force(sum->snapshot(), some_threads())), "");
                }
              },
              w.get());
        }
        if (this_job().size() > 1 && periodic) {
          EXPECT_GT(moved, 0u) << "else nothing was tested";
        }
        EXPECT_EQ(sum->lost(), alone->lost());
        EXPECT_EQ(sum->lost() > 0, leaves);
        const particle_table a = alone->snapshot(), b = sum->snapshot();
        ASSERT_EQ(a.kind, b.kind);
        double farthest = 0;
        for (std::size_t d = 0; d < a.x.size(); ++d)
          for (std::size_t i = 0; i < a.size(); ++i) {
            if (a.kind[i] == particle_kind::lost) continue;
            double by = std::abs(a.x[d][i] - b.x[d][i]);
            if (periodic) by = std::min(by, world.omega_high[d] - world.omega_low[d] - by);
            farthest = std::max(farthest, by);
          }
        EXPECT_LT(farthest, 1e-9);
      }
}

}  // namespace
}  // namespace pairsum

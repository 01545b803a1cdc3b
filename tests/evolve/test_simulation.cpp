#include <pairsum/core/error.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "harness/evolve/simulate_registry.hpp"
#include "harness/evolve/simulation.hpp"

namespace pairsum::harness {
namespace {

/// A simulation with all that it borrows.
struct run_of {
  initial_condition domain;
  workers threads;
  simulation steps;

  run_of(const initial_condition& c, moment from, const std::string& backend, const step_rules& rules, int n = 2,
         const std::string& interaction = "ferrari09_hard")
      : domain(c),
        threads(kind_of(backend), kind_of(backend) == runtime::serial ? 1 : n),
        steps(sum_of(c, backend, interaction), domain, std::move(from), rules, threads.get()) {}

  static runtime kind_of(const std::string& backend) {
    return registry::instance().find_backend(backend).traits.threads;
  }
  static std::unique_ptr<summation> sum_of(const initial_condition& c, const std::string& backend,
                                           const std::string& interaction) {
    setup s = setup_of(c);
    s.backend = backend;
    s.interaction = interaction;
    s.grid = "compact_grid";
    return simulate_registry().make_summation(s);
  }
  moment go_to(double t) {
    while (steps.t() < t) steps.step(t);
    return steps.save();
  }
};

initial_condition dam(int dim, double dx) { return make_case("dam_break", {.dim = dim, .dx = dx}); }

bool same(const moment& a, const moment& b) {
  const particle_table &p = a.particles, &q = b.particles;
  return p.x == q.x && p.v == q.v && p.rho == q.rho && p.m == q.m && p.kind == q.kind && a.ids == b.ids && a.t == b.t &&
         a.step == b.step && a.next_dt == b.next_dt && a.lost == b.lost;
}

TEST(ferrari09_hard, pushes_within_a_spacing_where_that_is_known) {
  initial_condition c = dam(2, 0.05);  // the fluid begins a spacing away from its walls
  c.H = 0.15;
  const auto rates = [&](const std::string& interaction, double dx) {
    setup s = setup_of(c);
    s.backend = "naive";
    s.interaction = interaction;
    s.grid = "compact_grid";
    s.constants.dx = dx;
    const auto sum = simulate_registry().make_summation(s);
    const workers serial(runtime::serial, 1);
    sum->load(c.particles, {}, serial.get());
    sum->evaluate(serial.get());
    return sum->rates().columns;
  };
  EXPECT_EQ(rates("ferrari09_hard", 0.049), rates("ferrari09", 0));
  EXPECT_NE(rates("ferrari09_hard", 0), rates("ferrari09", 0)) << "H/2 reaches the fluid";
}

TEST(simulation, goes_on_with_the_same_bits) {
  const initial_condition c = dam(2, 0.05);
  for (const std::string backend : {"symmetric", "naive_omp", "sliced_2colour", "tiles_omp", "verlet_list"}) {
    run_of whole(c, start_of(c.particles), backend, {});
    const moment half = whole.go_to(0.05), end = whole.go_to(0.1);
    EXPECT_EQ(end.t, 0.1);
    run_of later(c, half, backend, {}, 3);  // with another number of threads
    EXPECT_TRUE(same(later.go_to(0.1), end)) << backend;
    run_of other(c, half, backend, {.cfl = 0.19});
    EXPECT_FALSE(same(other.go_to(0.1), end)) << backend;
  }
}

TEST(simulation, walls_hold_where_mirrored_ones_leak) {
  for (const auto& [dim, dx] : {std::pair(2, 0.03), std::pair(3, 0.06)}) {
    const initial_condition c = dam(dim, dx);
    run_of hard(c, start_of(c.particles), "sliced_2colour", {});
    EXPECT_EQ(hard.go_to(0.5).lost, 0u) << dim;
    run_of mirrored(c, start_of(c.particles), "sliced_2colour", {}, 2, "ferrari09");
    const moment end = mirrored.go_to(0.5);
    EXPECT_GT(end.lost, 0u) << dim;
    EXPECT_EQ(end.particles.size() + end.lost, c.particles.size());
    EXPECT_EQ(end.ids.size(), end.particles.size());
  }
}

std::string error_of(const initial_condition& c, const step_rules& rules, double until, const char* interaction) {
  run_of run(c, start_of(c.particles), "symmetric", rules, 1, interaction);
  try {
    run.go_to(until);
  } catch (const error& e) {
    return e.what();
  }
  return "";
}

TEST(simulation, stops_with_step_and_particle) {
  const initial_condition c = dam(2, 0.05);
  EXPECT_NE(error_of(c, {.drop = false}, 1, "ferrari09").find("left Omega"), std::string::npos);
  const std::string apart = error_of(c, {.dt = 0.02}, 1, "ferrari09_hard");
  EXPECT_TRUE(apart.starts_with("step ")) << apart;
  EXPECT_NE(apart.find("particle "), std::string::npos) << apart;
  EXPECT_TRUE(apart.find("flies apart") != std::string::npos || apart.find("not finite") != std::string::npos) << apart;
}

TEST(simulation, a_step_ends_where_it_is_told_to) {
  const initial_condition c = dam(2, 0.1);
  run_of run(c, start_of(c.particles), "symmetric", {.dt = 0.001}, 1);
  run.steps.step(1);
  EXPECT_EQ(run.steps.t(), 0.001);
  run.steps.step(0.0015);
  EXPECT_EQ(run.steps.t(), 0.0015);
  EXPECT_EQ(run.steps.steps(), 2u);
}

}  // namespace
}  // namespace pairsum::harness

#include <gtest/gtest.h>

#include <pairsum/core/random.hpp>
#include <pairsum/integrators/with_state.hpp>

#include "ranked_scene.hpp"

// Small boxes, every dimension and precision, particles given outside a periodic box, all of them lost.
namespace pairsum {
namespace {

using namespace test_kit;

/// Particles at random in a box with edges of so many H, every other one boundary.
scene random_scene(int dim, std::uint32_t n, double edge, bool periodic) {
  scene s;
  s.world.dim = dim;
  s.world.constants.H = 1;
  s.world.grid = "compact_grid";
  s.world.omega_low.assign(static_cast<std::size_t>(dim), 0);
  s.world.omega_high.assign(static_cast<std::size_t>(dim), edge);
  if (periodic) s.world.periodic = axes::all(dim);
  s.particles = particle_table(dim);
  s.particles.resize(n);
  const counter_random random(11);
  for (std::uint32_t k = 0; k < n; ++k) {
    for (std::uint32_t d = 0; d < static_cast<std::uint32_t>(dim); ++d) {
      s.particles.x[d][k] = edge * random.uniform(6 * k + d);
      s.particles.v[d][k] = random.uniform(6 * k + 3 + d, -1, 1);
    }
    s.particles.rho[k] = 1000 + k % 7;
    s.particles.m[k] = 1e-3 * (1 + k % 3);
    s.particles.kind[k] = k < n / 2 ? particle_kind::fluid : particle_kind::boundary;
  }
  return s;
}

/// Does the sum over all ranks agree with brute force?
std::string wrong(const setup& world, const particle_table& p, cut_pairs pairs) {
  auto sum = ranked(world, {.pairs = pairs});
  const workers w(sum->traits().threads, 2);
  sum->load(p, {});
  sum->evaluate(w.get());
  return disagreement(sum->rates(), registry::instance().make_reference(world)->brute_force(p, team()));
}

TEST(corner_cases, boxes_of_a_few_cutoffs) {
  for (const double edge : {3.0, 3.5, 4.0, 5.0})
    for (const char* backend : {"naive_omp", "symmetric", "tiles_omp", "half_cells", "pair_list", "touched_blocks"})
      for (const cut_pairs pairs : {cut_pairs::twice, cut_pairs::once}) {
        if (pairs == cut_pairs::once && std::string(backend) == "naive_omp") continue;
        const scene s = random_scene(3, 500, edge, true);
        EXPECT_EQ(wrong(with(s.world, backend, {"compact_grid", 0}), s.particles, pairs), "") << edge << " " << backend;
      }
}

TEST(corner_cases, every_dimension_and_precision) {
  for (const formula_choice& f : formulas()) {
    if (f.interaction != "ferrari09" || f.smoothing != "wendland_c2") continue;
    for (const bool periodic : {false, true})
      for (const char* backend : {"symmetric", "tiles_omp", "half_cells"})
        for (const cut_pairs pairs : {cut_pairs::twice, cut_pairs::once}) {
          const scene s = random_scene(f.dim, 400, f.dim == 3 ? 5 : 20, periodic);
          setup world = with(s.world, f, backend, {"compact_grid", 0});
          world.isa = f.precision == "mixed" ? "best" : "default";
          EXPECT_EQ(wrong(world, s.particles, pairs), "") << f << " " << periodic << " " << backend;
        }
  }
}

TEST(corner_cases, given_outside_a_periodic_box) {
  for (const bool fluid : {false, true})
    for (const double edges : {1.0, -3.0}) {
      scene s = random_scene(3, 1000, 6, true);
      for (std::uint32_t k = 0; k < s.particles.size(); ++k)
        if (fluid || s.particles.kind[k] == particle_kind::boundary)
          for (auto& x : s.particles.x) x[k] += edges * 6;
      const setup world = with(s.world, "symmetric", {"compact_grid", 0}, "count");
      EXPECT_EQ(wrong(world, s.particles, cut_pairs::once), "") << fluid << " " << edges;
    }
}

TEST(corner_cases, all_are_lost) {
  const scene s = random_scene(3, 300, 6, false);
  auto sum = ranked(with(s.world, "symmetric", {"compact_grid", 0}), {.partition_every = 1});
  sum->load(s.particles, {});
  sum->evaluate(team());
  with_state(*sum, [&]<int D, class R>(state<D, R>& st) {
    auto& p = st.particles();
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.kind[i] == particle_kind::fluid) p.x[0][i] = 100;
  });
  for (int k = 0; k < 3; ++k) sum->evaluate(team());
  EXPECT_EQ(sum->lost(), 150u);
  const particle_table after = sum->snapshot();
  for (std::uint32_t i = 0; i < 150; ++i) {
    EXPECT_EQ(after.kind[i], particle_kind::lost);
    EXPECT_EQ(after.x[0][i], 100);
  }
}

}  // namespace
}  // namespace pairsum

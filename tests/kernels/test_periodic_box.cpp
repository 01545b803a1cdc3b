#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pairsum/integrators/integrator.hpp>
#include <pairsum/integrators/with_state.hpp>
#include "periodic_box.hpp"

// What a periodic box is: pairs through its faces, no place that is special, nothing that gets lost.
namespace pairsum {
namespace {

using namespace test_kit;

class periodic_box_test : public testing::TestWithParam<std::string> {
 protected:
  static int dim() { return registry::instance().dims().back(); }
};
INSTANTIATE_TEST_SUITE_P(backend, periodic_box_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

/// A disturbed lattice, N per axis, in a box of N/2 H.
scene lattice_of(int dim, int N, const std::string& state, double H = 0) {
  initial_condition made =
      make_case("periodic_lattice", {.dim = dim, .dx = 1.0 / N, .H = H, .state = state, .seed = 3});
  scene s;
  s.world.dim = dim;
  s.world.omega_low = made.omega_low;
  s.world.omega_high = made.omega_high;
  s.world.periodic = made.periodic;
  s.world.constants = {made.H, made.eos};
  s.particles = std::move(made.particles);
  return s;
}

TEST_P(periodic_box_test, two_particles_see_each_other_through_a_face) {
  for (int axis = 0; axis < dim(); ++axis)
    for (const double gap : {0.5, 0.999, 1.0, 1.5}) {
      scene s = placed(dim(), {1, 1, 1}, 0.125, 2, [&](std::size_t i) {
        std::array<double, 3> x{0.5, 0.5, 0.5};
        x[static_cast<std::size_t>(axis)] = i == 0 ? 0.03125 : 1 + 0.03125 - gap * 0.125;
        return x;
      });
      for (const grid_choice& grid : grids_round(counting(s, GetParam(), 2))) {
        const auto sum = evaluated(counting(s, GetParam(), grid), s.particles);
        EXPECT_EQ(sum->rates().columns[0], std::vector<double>(2, gap < 1 ? 1 : 0)) << grid << " " << gap;
        EXPECT_EQ(sum->count_work().pairs_fluid_fluid, gap < 1 ? 1u : 0u);
      }
      s.particles.rho.assign(2, 1010);  // under pressure
      const auto rates = evaluated(with(s.world, GetParam(), 2), s.particles)->rates();
      const double push = rates.columns[1 + static_cast<std::size_t>(axis)][0];
      EXPECT_EQ(push > 0, gap < 1) << "away from the face, and from the other";
      EXPECT_EQ(rates.columns[1 + static_cast<std::size_t>(axis)][1], -push);
    }
}

/// Offsets o of a lattice with |o| < 2.5 and |o| < 2: every particle has all of them.
TEST_P(periodic_box_test, all_of_a_lattice_have_as_many_neighbours) {
  const double sides[4] = {0, 4, 20, 80};
  const double near_sides[4] = {0, 2, 8, 26};
  for (const int D : registry::instance().dims()) {
    const scene s = lattice_of(D, 20, "rest", 2.5 / 20), exact = lattice_of(D, 16, "rest");
    for (const grid_choice& grid : grids_round(counting(exact, GetParam(), 2), {2, 3})) {
      const auto near = evaluated(counting(exact, GetParam(), grid), exact.particles, 2);
      const auto wide = evaluated(counting(s, GetParam(), grid), s.particles, 2);
      EXPECT_EQ(near->rates().columns[0], std::vector<double>(exact.particles.size(), near_sides[D])) << grid;
      EXPECT_EQ(wide->rates().columns[0], std::vector<double>(s.particles.size(), sides[D])) << grid;
      EXPECT_EQ(wide->count_work().pairs_fluid_fluid, s.particles.size() * static_cast<std::size_t>(sides[D]) / 2);
      EXPECT_EQ(near->count_work().pairs_fluid_fluid,
                exact.particles.size() * static_cast<std::size_t>(near_sides[D]) / 2);
    }
  }
}

/// Moved by any vector, the same pairs interact; positions are multiples of 2^-12, so that nothing is rounded.
TEST_P(periodic_box_test, has_no_place_that_is_special) {
  scene s = lattice_of(dim(), 14, "perturbed", 0.125);
  for (auto& x : s.particles.x)
    for (double& a : x) a = std::round(a * 4096) / 4096;
  const auto before = evaluated(counting(s, GetParam(), 2), s.particles)->rates().columns;
  const counter_random random(5);
  for (std::uint64_t n = 0; n < 6; ++n) {
    scene moved = s;
    for (std::size_t d = 0; d < s.particles.x.size(); ++d)
      for (double& a : moved.particles.x[d]) a = std::fmod(a + std::round(random.uniform(3 * n + d) * 4096) / 4096, 1);
    for (const grid_choice& grid : grids_round(with(s.world, GetParam(), 2), {2, 3}))
      EXPECT_EQ(evaluated(counting(moved, GetParam(), grid), moved.particles, 2)->rates().columns, before) << grid;
  }
}

TEST_P(periodic_box_test, momentum_is_conserved) {
  scene s = lattice_of(dim(), 14, "perturbed", 0.125);
  for (std::size_t i = 0; i < s.particles.size(); ++i) s.particles.m[i] *= 1 + 0.1 * static_cast<double>(i % 5);
  const auto e =
      registry::instance().make_reference(with(s.world, "naive", 3))->brute_force(s.particles, some_threads());
  for (const grid_choice& grid : grids_round(with(s.world, GetParam(), 2), {3})) {
    const auto rates = evaluated(with(s.world, GetParam(), grid), s.particles, 3)->rates();
    EXPECT_EQ(disagreement(rates, e), "") << grid;
    for (std::size_t d = 0; d < s.particles.x.size(); ++d) {
      long double rate = 0, bound = 0;
      for (std::size_t i = 0; i < s.particles.size(); ++i) {
        rate += static_cast<long double>(s.particles.m[i]) * rates.columns[1 + d][i];
        bound += static_cast<long double>(s.particles.m[i]) * e.bound[1 + d][i];
      }
      EXPECT_LE(std::abs(rate), bound) << grid;
      EXPECT_GT(bound, 0);
    }
  }
}

/// Everything drifts by more than an edge in 50 steps, through the faces.
TEST_P(periodic_box_test, who_leaves_comes_back_through_the_opposite_face) {
  scene s = lattice_of(dim(), 10, "perturbed", 0.2);
  for (std::size_t d = 0; d < s.particles.x.size(); ++d)
    for (double& v : s.particles.v[d]) v += d == 1 ? -210 : 210;
  for (const char* integrator : {"euler", "rk4"}) {
    const auto sum = registry::instance().make_summation(with(s.world, GetParam(), 2));
    workers w(sum->traits().threads, 2);
    sum->load(s.particles, {});
    for (int step = 0; step < 50; ++step)
      find_integrator(integrator)
          .step(
              *sum, 1e-4, 0, [&] { sum->evaluate(w.get()); }, w.get());
    sum->evaluate(w.get());
    const particle_table now = sum->snapshot();
    EXPECT_EQ(sum->lost(), 0u);
    EXPECT_EQ(now.count(particle_kind::fluid), s.particles.size());
    for (const auto& x : now.x)
      for (const double a : x) ASSERT_TRUE(a >= 0 && a < 1) << a;
    const auto expected =
        registry::instance().make_reference(with(s.world, "naive", 2))->brute_force(now, some_threads());
    EXPECT_EQ(disagreement(sum->rates(), expected), "") << integrator;
  }
}

TEST_P(periodic_box_test, only_what_is_no_number_is_lost) {
  const scene s = lattice_of(dim(), 10, "perturbed", 0.2);
  for (const grid_choice& grid : grids_round(with(s.world, GetParam(), 2), {2})) {
    const auto sum = evaluated(with(s.world, GetParam(), grid), s.particles);
    with_state(*sum, [&]<int D, class R>(state<D, R>& st) {
      st.particles().x[0][5] = R(1.25);
      st.particles().x[0][6] = R(-7.5);
      st.particles().x[0][7] = std::numeric_limits<R>::quiet_NaN();
      st.particles().x[0][8] = std::numeric_limits<R>::infinity();
      st.particles().x[0][9] = R(1);
    });
    workers w(sum->traits().threads, 1);
    sum->evaluate(w.get());
    EXPECT_EQ(sum->lost(), 2u) << grid;
    const particle_table now = sum->snapshot();
    EXPECT_EQ(std::ranges::count(now.x[0], 0.25) + std::ranges::count(now.x[0], 0.5), 2);
    EXPECT_EQ(std::ranges::count(now.x[0], 0), 1);
    const auto expected =
        registry::instance().make_reference(with(s.world, "naive", 2))->brute_force(now, some_threads());
    EXPECT_EQ(disagreement(sum->rates(), expected), "") << grid;
  }
}

TEST_P(periodic_box_test, has_the_same_bits_for_every_number_of_threads) {
  const auto& traits = registry::instance().find_backend(GetParam()).traits;
  if (!traits.deterministic) GTEST_SKIP();
  const scene s = lattice_of(dim(), 20, "perturbed");
  for (const grid_choice& grid : grids_round(with(s.world, GetParam(), 2), {2, 3})) {
    const auto expected = evaluated(with(s.world, GetParam(), grid), s.particles, 1)->fingerprint();
    for (const int threads : {2, 3, 7})
      EXPECT_EQ(evaluated(with(s.world, GetParam(), grid), s.particles, threads)->fingerprint(), expected)
          << grid << " threads=" << threads;
  }
}

/// Boundary particles of a periodic box act through its faces too.
TEST_P(periodic_box_test, walls_act_through_the_faces) {
  scene s = placed(dim(), {1, 1, 1}, 0.125, 2, [&](std::size_t i) {
    return std::array<double, 3>{i == 0 ? 0.015625 : 0.984375, 0.5, 0.5};
  });
  s.particles.kind[1] = particle_kind::boundary;
  s.particles.rho[0] = 1010;  // under pressure
  for (const grid_choice& grid : grids_round(with(s.world, GetParam(), 2), {3})) {
    EXPECT_EQ(evaluated(counting(s, GetParam(), grid), s.particles)->rates().columns[0], (std::vector<double>{1, 0}));
    const setup world = with(s.world, GetParam(), grid);
    const auto rates = evaluated(world, s.particles)->rates();
    EXPECT_GT(rates.columns[1][0], 0) << "away from the wall";
    EXPECT_EQ(disagreement(rates, registry::instance().make_reference(world)->brute_force(s.particles, team())), "");
  }
}

/// Open and periodic axes side by side, axes of 3 cells among them: on everything that sums, within the bound, `count`
/// exactly, and without pushing the whole.
TEST_P(periodic_box_test, axes_are_open_or_closed_each_for_itself) {
  std::size_t summed = 0;
  for (const narrow_box& box : narrow_boxes()) {
    const scene mixture = box.make(300, 60), fluid = box.make(300, 0);
    for (const std::string& precision : registry::instance().precisions())
      for (const char* interaction : {"ferrari09", "count"}) {
        const bool counts = interaction == std::string("count");
        if (counts && precision == "mixed") continue;
        const scene& s = counts ? mixture : fluid;
        formula_choice f{box.dim, precision, interaction, counts ? "none" : "wendland_c2"};
        const setup words = with(s.world, f, GetParam(), 2);
        const auto e = registry::instance().make_reference(words)->brute_force(s.particles, some_threads());
        ASSERT_GT(e.pairs_fluid_fluid, 100u) << box;
        for (const grid_choice& grid : grids_round(words))
          for (const std::string& isa : isas_for(f, GetParam())) {
            setup world = with(s.world, f, GetParam(), grid);
            world.isa = isa;
            SCOPED_TRACE(testing::Message() << box << " " << f << " " << grid << " " << isa);
            const rate_table rates = evaluated(world, s.particles, 3)->rates();
            ASSERT_EQ(disagreement(rates, e), "");
            ++summed;
            if (counts) {
              ASSERT_EQ(rates.columns, count_by_hand(s, precision).columns);
              continue;
            }
            for (std::size_t d = 0; d < s.particles.x.size(); ++d) {
              long double rate = 0, bound = 0;
              for (std::size_t i = 0; i < s.particles.size(); ++i) {
                rate += static_cast<long double>(s.particles.m[i]) * rates.columns[1 + d][i];
                bound += static_cast<long double>(s.particles.m[i]) * e.bound[1 + d][i];
              }
              EXPECT_LE(std::abs(rate), bound) << "momentum";
            }
          }
      }
  }
  EXPECT_GT(summed, 4 * narrow_boxes().size());
}

/// Through a periodic face everything comes back; what goes through another is lost.
TEST_P(periodic_box_test, who_leaves_along_an_open_axis_is_lost) {
  for (const narrow_box& box : narrow_boxes()) {
    if (box.dim != dim() || box.reaches[0] < 1) continue;  // all would leave
    scene s = box.make(300, 0);
    for (std::size_t d = 0; d < s.particles.x.size(); ++d)
      for (std::size_t i = 0; i < s.particles.size(); ++i)
        s.particles.v[d][i] = d == 1 ? -1 : 1 + 0.001 * static_cast<double>(i);
    for (const grid_choice& grid : grids_round(with(s.world, GetParam(), 2), {2})) {
      SCOPED_TRACE(testing::Message() << box << " " << grid);
      const setup world = with(s.world, GetParam(), grid);
      const auto sum = registry::instance().make_summation(world);
      const workers w(sum->traits().threads, 2);
      sum->load(s.particles, {});
      for (int step = 0; step < 25; ++step)  // of 0.1 H each
        with_state(*sum, [&]<int D, class R>(state<D, R>& st) {
          sum->evaluate(w.get());
          auto& p = st.particles();
          for (int d = 0; d < D; ++d)
            for (std::size_t i = 0; i < p.size(); ++i) p.x[d][i] += p.v[d][i] * R(0.0125);
        });
      sum->evaluate(w.get());
      const particle_table now = sum->snapshot();
      const std::size_t kept = now.count(particle_kind::fluid);
      EXPECT_EQ(sum->lost() + kept, s.particles.size());
      EXPECT_GT(kept, 0u);
      EXPECT_EQ(sum->lost() > 0, box.periodic != axes::all(box.dim));
      for (std::size_t d = 0; d < now.x.size(); ++d)
        for (std::size_t i = 0; i < now.size(); ++i)
          if (box.periodic.on[d] || now.kind[i] == particle_kind::fluid) {
            ASSERT_TRUE(now.x[d][i] >= world.omega_low[d] && now.x[d][i] <= world.omega_high[d]) << now.x[d][i];
          }
      const auto expected = registry::instance().make_reference(world)->brute_force(now, some_threads());
      EXPECT_GT(expected.pairs_fluid_fluid, 0u);
      EXPECT_EQ(disagreement(sum->rates(), expected), "");
    }
  }
}

/// Snapshots of other programs have particles beyond the faces.
TEST_P(periodic_box_test, particles_may_begin_beyond_periodic_faces) {
  for (const narrow_box& box : narrow_boxes()) {
    scene s = box.make(200, 40);
    const setup world = counting(s, GetParam(), grid_choice("compact_grid", 0));
    if (!goes_round(world)) continue;
    const auto inside = evaluated(world, s.particles, 2)->rates().columns;
    for (std::size_t d = 0; d < s.particles.x.size(); ++d)
      for (std::size_t i = 0; i < s.particles.size() && box.periodic.on[d]; ++i)
        s.particles.x[d][i] += (static_cast<double>((i + d) % 3) - 1) * s.world.omega_high[d];
    EXPECT_EQ(evaluated(world, s.particles, 2)->rates().columns, inside) << box;
  }
}

TEST(periodic_box, what_is_too_small_is_refused) {
  const int dim = registry::instance().dims().back();
  scene s = placed(dim, {1, 1, 1}, 0.34, 1, [](std::size_t) { return std::array<double, 3>{0.5, 0.5, 0.5}; });
  const auto refusal = [&](const grid_choice& grid) {
    return error_of([&] { (void)registry::instance().make_summation(with(s.world, "naive", grid)); });
  };
  for (const grid_choice& grid : every_grid({2}))
    EXPECT_TRUE(says(refusal(grid), {"a periodic box must be 3 support radii or more along each periodic axis"}))
        << grid;
  for (const grid_choice& grid : every_grid({2})) {
    s.world.constants.H = 0.26;
    if (grid.M > 0)
      EXPECT_TRUE(says(refusal(grid),
                       {"hashed grid does not fit the periodic box of 3.8", "dense_grid and compact_grid take 3"}))
          << refusal(grid);
    else
      EXPECT_EQ(refusal(grid), "") << grid;
    s.world.constants.H = 0.25;
    EXPECT_EQ(refusal(grid), "") << grid;
  }
  // 3 H as they are: no number is 0.1, so that rounding leaves no room for 3 cells; the refusal says which H has it.
  s.world.omega_low.assign(s.world.omega_low.size(), 0);
  s.world.omega_high.assign(s.world.omega_low.size(), 0.3);
  for (const grid_choice& grid : every_grid({2})) {
    s.world.constants.H = 0.1;
    const std::string said = refusal(grid), before = "what rounding takes; one of ";
    ASSERT_TRUE(says(said, {"the periodic box of 2.99", "support radii is too small: 3 cells must fit", before}))
        << said;
    s.world.constants.H = std::stod(said.substr(said.find(before) + before.size()));
    EXPECT_NEAR(s.world.constants.H, 0.1, 1e-14);
    EXPECT_EQ(refusal(grid) == "", grid.M == 0) << grid;
  }
  // An open axis may be as narrow as it likes.
  s.world.constants.H = 0.34;
  s.world.omega_high.assign(s.world.omega_low.size(), 1);
  s.world.omega_high[0] = 1.4;
  s.world.periodic = along_x;
  for (const grid_choice& grid : every_grid({2})) EXPECT_EQ(refusal(grid), "") << grid;
  s.world.periodic = axes::all(dim);
  s.world.omega_low.assign(s.world.omega_low.size(), -0.5);
  s.world.omega_high.assign(s.world.omega_low.size(), 0.5);
  s.world.constants.H = 0.06;
  const std::string text = refusal(6);
  EXPECT_TRUE(says(text, {"M = 6", "does not fit the periodic box", "64 cells", "M from 2 to 4 fit"})) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
  s.world.constants.H = 0.2;
  EXPECT_TRUE(says(refusal(3), {"M = 3", "M = 2 fits"})) << refusal(3);
}

TEST(periodic_box, a_fluid_particle_on_a_wall_is_found_through_the_face) {
  if (error_of([] { registry::instance().check_interaction("monaghan94"); }) != "") GTEST_SKIP() << "not built";
  scene s = placed(registry::instance().dims().back(), {1, 1, 1}, 0.125, 2, [](std::size_t i) {
    return std::array<double, 3>{i == 0 ? 0.0 : 1.0, 0.5, 0.5};
  });
  s.particles.kind[1] = particle_kind::boundary;
  const setup world = with(s.world, "naive", 3, "monaghan94");
  EXPECT_TRUE(says(error_of([&] { evaluated(world, s.particles); }), {"fluid particle 0 lies exactly on boundary"}));
}

}  // namespace
}  // namespace pairsum

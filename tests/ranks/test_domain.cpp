#include <gtest/gtest.h>

#include <cmath>

#include <pairsum/core/random.hpp>
#include <pairsum/ranks/domain.hpp>

#include "ranked_scene.hpp"

// Where particles go, and what is said of that.
namespace pairsum {
namespace {

using namespace test_kit;

/// n^3 particles of spacing 1, in a box that they fill to half a spacing; H is 2.1 spacings.
scene cube(int n, bool periodic) {
  scene s;
  s.world.constants.H = 2.1;
  s.world.grid = "compact_grid";
  s.world.omega_low = {0, 0, 0};
  s.world.omega_high.assign(3, n);
  for (int d = 0; d < 3; ++d) s.world.periodic.on[static_cast<std::size_t>(d)] = periodic;
  s.particles.resize(static_cast<std::size_t>(n * n * n));
  for (std::size_t k = 0; k < s.particles.size(); ++k) {
    const auto i = static_cast<int>(k);
    s.particles.x[0][k] = i % n + 0.5;
    s.particles.x[1][k] = i / n % n + 0.5;
    s.particles.x[2][k] = i / n / n + 0.5;
    s.particles.rho[k] = 1000;
    s.particles.m[k] = 1;
    s.particles.kind[k] = particle_kind::fluid;
  }
  return s;
}

/// Offsets of a lattice within 2.1 spacings.
template <class F>
void each_offset(F&& f) {
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (x * x + y * y + z * z > 0 && x * x + y * y + z * z <= 4) f(x, y, z);
}

/// Two ranks share a cube of n^3, cut in the middle, by layers: 2 layers of n^2 on each side of a cut are ghosts, and a
/// pair is cut if its offset leads across. Periodic along the cut axis there are two cuts.
TEST(closed_forms, of_a_cube_that_two_ranks_share) {
  if (this_job().size() != 2) GTEST_SKIP() << "for two ranks";
  for (const bool periodic : {false, true})
    for (const cut_pairs pairs : {cut_pairs::twice, cut_pairs::once}) {
      const int n = 12, cuts = periodic ? 2 : 1;
      const scene s = cube(n, periodic);
      auto sum = ranked(with(s.world, "symmetric", {"compact_grid", 0}), {.pairs = pairs});
      sum->load(s.particles, {});
      sum->evaluate(team());
      std::uint64_t cut = 0;
      each_offset([&](int x, int y, int z) {
        const int free = periodic ? n * n : (n - std::abs(y)) * (n - std::abs(z));
        if (x > 0) cut += static_cast<std::uint64_t>(x * free);
      });
      const auto facts = ranks::facts_of(*sum);
      const auto layer = static_cast<std::uint64_t>(n * n);
      const std::uint64_t record = 8 * (3 + 3 + 2) + 4 + 1, rates = 8 * (1 + 3);
      std::uint64_t summed = 0;
      for (const ranks::rank_facts& f : facts) {
        EXPECT_EQ(f.own, layer * 6);
        EXPECT_EQ(f.ghosts, 2 * layer * cuts);
        EXPECT_EQ(f.halo.messages, 1u) << "one for both cuts";
        EXPECT_EQ(f.halo.bytes, f.ghosts * record);
        EXPECT_EQ(f.migrate.messages, 0u);
        EXPECT_EQ(f.send_back.messages, pairs == cut_pairs::once ? 1u : 0u);
        EXPECT_EQ(f.send_back.bytes, pairs == cut_pairs::once ? f.ghosts * rates : 0u);
        summed += f.cut;
      }
      EXPECT_EQ(summed, cut * cuts * (pairs == cut_pairs::once ? 1 : 2));
      EXPECT_EQ(sum->count_work().pairs_cut, cut * cuts);
      sum->evaluate(team());  // nobody has moved: positions, velocities and densities alone
      for (const ranks::rank_facts& f : ranks::facts_of(*sum)) EXPECT_EQ(f.halo.bytes, f.ghosts * 8 * 7);
      for (const ranks::rank_facts& f : facts)
        if (pairs == cut_pairs::once) {
          EXPECT_NEAR(static_cast<double>(f.cut), 0.5 * static_cast<double>(summed), 0.1 * static_cast<double>(summed))
              << "the work of the border is shared";
        }
    }
}

TEST(domain, more_ranks_than_particles) {
  const scene s = cube(2, false);
  scene one = s;
  for (auto& c : one.particles.x) c.resize(1);
  for (auto& c : one.particles.v) c.resize(1);
  one.particles.rho.resize(1), one.particles.m.resize(1), one.particles.kind.resize(1);
  for (const scene* all : {&s, static_cast<const scene*>(&one)}) {
    const setup world = with(all->world, "symmetric_omp", {"compact_grid", 0}, "count");
    auto sum = ranked(world, {.pairs = cut_pairs::once});
    const workers w(runtime::omp, 2);
    sum->load(all->particles, {});
    sum->evaluate(w.get());
    const auto e = registry::instance().make_reference(world)->brute_force(all->particles, team());
    EXPECT_EQ(disagreement(sum->rates(), e), "");
    std::uint64_t own = 0;
    for (const auto& f : ranks::facts_of(*sum)) own += f.own;
    EXPECT_EQ(own, all->particles.size());
  }
}

/// All in one place, which no cut divides: one rank has them all.
TEST(domain, all_particles_on_one_rank) {
  scene s = cube(3, false);
  for (auto& c : s.particles.x) std::fill(c.begin(), c.end(), 1.5);
  const setup world = with(s.world, "symmetric", {"compact_grid", 0}, "count");
  auto sum = ranked(world, {});
  sum->load(s.particles, {});
  sum->evaluate(team());
  const auto e = registry::instance().make_reference(world)->brute_force(s.particles, team());
  EXPECT_EQ(disagreement(sum->rates(), e), "");
  std::uint64_t most = 0;
  for (const auto& f : ranks::facts_of(*sum)) most = std::max(most, f.own);
  EXPECT_EQ(most, s.particles.size());
}

/// Boxes narrower than the cutoff: ghosts come from ranks beyond the neighbours.
TEST(domain, a_halo_wider_than_a_neighbours_box) {
  for (const bool periodic : {false, true}) {
    scene s = cube(9, periodic);
    for (auto& x : s.particles.x[1]) x = 4.5 + (x - 4.5) / 3;
    for (auto& x : s.particles.x[2]) x = 4.5 + (x - 4.5) / 3;
    const setup world = with(s.world, "symmetric", {"compact_grid", 0}, "count");
    auto sum = ranked(world, {.pairs = cut_pairs::once});
    sum->load(s.particles, {});
    sum->evaluate(team());
    const auto e = registry::instance().make_reference(world)->brute_force(s.particles, team());
    EXPECT_EQ(disagreement(sum->rates(), e), "");
  }
}

/// What the tests of all backends would see if a halo were too narrow: rates beyond their bounds.
TEST(domain, a_halo_of_less_than_the_cutoff_is_found_out) {
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  const setup world = with(s.world, "symmetric", {"compact_grid", 0}, "count");
  const auto e = registry::instance().make_reference(world)->brute_force(s.particles, team());
  for (const double share : {1.0, 0.2}) {
    const auto local = registry::instance().make_summation(world);
    auto& part = dynamic_cast<state<3, double>&>(*local);
    part.sum_ghosts(cut_pairs::twice);
    ranks::domain<3, double> d(part, share * world.constants.H, 0);
    d.load(s.particles, {}, ranks::balance::particles);
    d.halo();
    local->evaluate(team());
    expectation own = e;
    const auto is_other = [&](std::uint32_t id) {
      const auto& p = part.particles();
      for (std::size_t i = 0; i < p.size(); ++i)
        if (p.id[i] == id && p.kind[i] == particle_kind::fluid) return false;
      return true;
    };
    std::vector<std::size_t> mine;
    for (std::size_t k = 0; k < e.ids.size(); ++k)
      if (!is_other(e.ids[k])) mine.push_back(k);
    own.ids.clear();
    for (auto* table : {&own.value, &own.bound})
      for (auto& column : *table) column.clear();
    for (const std::size_t k : mine) {
      own.ids.push_back(e.ids[k]);
      for (std::size_t c = 0; c < e.value.size(); ++c) {
        own.value[c].push_back(e.value[c][k]);
        own.bound[c].push_back(e.bound[c][k]);
      }
    }
    const std::string found = disagreement(local->rates(), own, false);
    bool found_out = false;
    for (const std::string& of_rank : this_job().gather(found)) found_out = found_out || !of_rank.empty();
    EXPECT_EQ(found_out, share < 1 && this_job().size() > 1) << found;
  }
}

/// Half of the particles lie in a corner, 30 times as close as the others.
TEST(domain, weights_by_pairs_balance_them) {
  scene s = cube(16, false);
  const counter_random random(7);
  for (std::uint32_t k = 0; k < s.particles.size(); ++k)
    for (std::uint32_t d = 0; d < 3; ++d) s.particles.x[d][k] = random.uniform(3 * k + d) * (k % 2 == 0 ? 16 : 5);
  const auto imbalance = [&](ranks::balance weights) {
    auto sum = ranked(with(s.world, "symmetric", {"compact_grid", 0}), {.weights = weights, .partition_every = 1});
    sum->load(s.particles, {});
    sum->evaluate(team());
    sum->evaluate(team());  // the second partition knows the pairs of the first
    double most = 0, all = 0;
    const auto facts = ranks::facts_of(*sum);
    for (const auto& f : facts) {
      most = std::max(most, static_cast<double>(f.pairs));
      all += static_cast<double>(f.pairs);
    }
    return most / all * static_cast<double>(facts.size());
  };
  const double particles = imbalance(ranks::balance::particles), pairs = imbalance(ranks::balance::pairs);
  if (this_job().size() == 1) return;
  EXPECT_GT(particles, 1.3);
  EXPECT_LT(pairs, 0.9 * particles);
}

}  // namespace
}  // namespace pairsum

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

#include <pairsum/core/omp_locks.hpp>
#include "any_world.hpp"

// The backends that cut the world into slabs or tasks, where it can hardly be cut: fewer layers than threads, rings of
// four layers, few particles, a team other than the one that prepared.
namespace pairsum {
namespace {

using namespace test_kit;

const std::string cutters[] = {"sliced_locks", "sliced_2colour", "task_conflicts"};

class sliced_test : public testing::TestWithParam<std::tuple<std::string, world_kind>> {
 protected:
  const std::string& backend = std::get<0>(GetParam());
  const world_kind& kind = std::get<1>(GetParam());

  void expect_exact(const scene& s) const {
    const auto expected =
        registry::instance().make_reference(with(s.world, "naive", 2, "count"))->brute_force(s.particles, team());
    for (const grid_choice& grid : every_grid({2, 3, 5}))
      for (const int threads : {1, 2, 5, 16})
        EXPECT_EQ(
            disagreement(evaluated(with(s.world, backend, grid, "count"), s.particles, threads)->rates(), expected), "")
            << grid << ", " << threads << " threads";
  }
};
INSTANTIATE_TEST_SUITE_P(every, sliced_test,
                         testing::Combine(testing::ValuesIn(cutters), testing::ValuesIn(world_kinds())),
                         [](const auto& i) {
                           return std::get<0>(i.param) + "_" + testing::PrintToString(std::get<1>(i.param));
                         });

TEST_P(sliced_test, fewer_layers_than_threads) {
  for (const double edges : {0.5, 1.5, 3.5, 6.0}) expect_exact(crowded_world(kind, edges, 150));
}

TEST_P(sliced_test, more_layers_than_slabs) { expect_exact(crowded_world(kind, 70, kind.dim == 1 ? 600 : 1500)); }

TEST_P(sliced_test, gaps_between_layers) { expect_exact(sparse_world(kind, 300, 200)); }

TEST_P(sliced_test, few_particles) {
  for (const std::uint32_t n : {0u, 1u, 2u}) expect_exact(crowded_world(kind, 3, n));
}

/// Slabs and tasks are of the team that prepared; any smaller one may sum them.
TEST_P(sliced_test, a_smaller_team_may_sum) {
  const scene s = crowded_world(kind, 12, 800);
  const auto sum = registry::instance().make_summation(with(s.world, backend, 3, "count"));
  const auto expected = evaluated(with(s.world, "naive", 3, "count"), s.particles)->rates().columns;
  sum->load(s.particles, {});
  const workers first(sum->traits().threads, 6);
  sum->index(first.get());
  sum->prepare(first.get());
  for (const int threads : {1, 2, 6}) {
    const workers w(sum->traits().threads, threads);
    sum->zero(w.get());
    sum->sum(w.get());
    sum->reduce(w.get());
    EXPECT_EQ(sum->rates().columns, expected) << threads;
  }
}

/// Particles that move between evaluations, so that cells come and go.
TEST_P(sliced_test, follow_particles_that_move) {
  const auto sum = registry::instance().make_summation(with(crowded_world(kind, 9, 0).world, backend, 3, "count"));
  const workers w(sum->traits().threads, 3);
  for (const std::uint32_t n : {700u, 20u, 0u, 300u}) {
    const scene s = crowded_world(kind, 9, n);
    sum->load(s.particles, {});
    for (int again = 0; again < 2; ++again) {
      sum->evaluate(w.get());
      EXPECT_EQ(sum->rates().columns, evaluated(with(s.world, "naive", 3, "count"), s.particles)->rates().columns) << n;
    }
  }
}

TEST(omp_locks, say_who_waits) {
  omp_locks locks;
  locks.resize(2);
  std::atomic<int> waits = 0, taken = 0;
  const auto wait = [&](auto&& until_free) {
    ++waits;
    until_free();
    ++taken;
  };
  { const omp_locks::guard free(locks, 0, 1, wait); }
  EXPECT_EQ(waits, 0);
  auto held = std::make_unique<omp_locks::guard>(locks, 0, 1, wait);
  std::thread other([&] { const omp_locks::guard later(locks, -1, 1, wait); });
  while (waits == 0) std::this_thread::yield();
  EXPECT_EQ(taken, 0) << "it is held";
  held.reset();
  other.join();
  EXPECT_EQ(waits, 1);
  EXPECT_EQ(taken, 1);
}

}  // namespace
}  // namespace pairsum

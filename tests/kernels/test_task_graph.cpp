#include <gtest/gtest.h>

#include <atomic>
#include <mutex>

#include <pairsum/core/random.hpp>
#include <pairsum/core/tbb_arena.hpp>
#include <pairsum/core/tbb_graph.hpp>
#include "scene.hpp"

// Tasks in an order: in the caller's arena, again and again, and after an exception.
namespace pairsum {
namespace {

using namespace test_kit;

constexpr std::size_t tasks = 300;

std::vector<task_order> random_order() {
  const counter_random random(5);
  std::vector<task_order> order;
  for (std::uint32_t b = 1; b < tasks; ++b)
    for (std::uint64_t k = 0; k < 3; ++k)
      if (random.bits(4 * b + k) % 2 == 0)
        order.push_back({static_cast<std::uint32_t>(random.bits(4 * b + k + 1000000) % b), b});
  std::ranges::sort(order);
  order.erase(std::unique(order.begin(), order.end()), order.end());
  return order;
}

/// Runs the tasks in an arena of their own, and returns what was wrong.
std::string run_in_arena(tbb_graph& graph, const std::vector<task_order>& order, int threads) {
  tbb_arena arena(threads);
  std::vector<std::atomic<int>> begun(tasks), ended(tasks);
  std::atomic<int> clock = 0, strangers = 0;
  arena.arena.execute([&] {
    graph.run([&](std::size_t k) {
      begun[k] = ++clock;
      strangers += ::tbb::this_task_arena::max_concurrency() != threads ||
                   ::tbb::this_task_arena::current_thread_index() >= threads;
      ended[k] = ++clock;
    });
  });
  if (strangers != 0) return "not in the caller's arena";
  if (clock != 2 * static_cast<int>(tasks)) return "not each once";
  for (const auto& [before, after] : order)
    if (begun[after] < ended[before]) return "out of order";
  return "";
}

TEST(task_graph, runs_in_order_in_the_arena_of_the_caller) {
  const auto order = random_order();
  tbb_graph graph(tasks, order);  // made outside any arena
  for (int run = 0; run < 30; ++run) EXPECT_EQ(run_in_arena(graph, order, 1 + run % 4), "");
  tbb_graph without(tasks, {});
  EXPECT_EQ(run_in_arena(without, order, 3), "out of order");
}

TEST(task_graph, of_no_tasks_is_done) {
  tbb_graph graph(0, {});
  EXPECT_NO_THROW(graph.run([](std::size_t) {}));
}

TEST(task_graph, hands_an_exception_on_and_can_be_run_again) {
  const auto order = random_order();
  tbb_graph graph(tasks, order);
  for (int run = 0; run < 5; ++run) {
    tbb_arena arena(3);
    const auto message = error_of([&] {
      arena.arena.execute([&] {
        graph.run([](std::size_t k) {
          if (k == 100) throw error("task 100");
        });
      });
    });
    EXPECT_EQ(message, "task 100");
    EXPECT_EQ(run_in_arena(graph, order, 2), "");
  }
}

/// Throws when it is told of work.
struct complains : pass_observer {
  void pass_begins(unsigned) override {}
  void work_begins(unsigned, int) override { throw error("an observer's own"); }
  void work_ends(unsigned, int) override {}
  void pass_ends(unsigned) override {}
};

TEST(task_graph, of_a_sum_that_failed_sums_again) {
  const scene s = make_scene("dam_break", 0.045, "perturbed");
  const auto expected = evaluated(with(s.world, "task_conflicts", 4), s.particles)->fingerprint();
  const auto sum = registry::instance().make_summation(with(s.world, "task_conflicts", 4));
  sum->load(s.particles, {});
  for (int run = 0; run < 3; ++run) {
    const workers w(runtime::tbb, 2);
    complains observer;
    sum->observe(&observer);
    EXPECT_EQ(error_of([&] { sum->evaluate(w.get()); }), "an observer's own");
    sum->observe(nullptr);
    sum->evaluate(w.get());
    EXPECT_EQ(sum->fingerprint(), expected);
  }
}

}  // namespace
}  // namespace pairsum

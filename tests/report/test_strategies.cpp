#include "harness/report/strategies.hpp"
#include "tests/report/report_fixture.hpp"

// The ladder of strategies, what they cost, and where they break down.
namespace pairsum::harness {
namespace {

using change = std::function<void(sample&)>;

/// Every phase timed: an evaluation takes 1.25 times the sum. What else is said comes on top.
change whole(const change& more = {}) {
  return [more](sample& s) {
    s.phases->reduce_s = 0;
    if (more) more(s);
  };
}

change holds(std::uint64_t bytes) {
  return whole([bytes](sample& s) { s.workspace_bytes = bytes; });
}

void waits(sample& s) {
  s.threads_busy_s = thread_times{{0.5, 0.25}};
  s.barrier_wait_s = thread_times{{0.0, 0.25}};
}

std::vector<made_point> field(const change& more = {}) {
  return {{"naive_omp", 6, 1, 1.0, 6, whole(more)},
          {"naive_omp", 6, 2, 0.5, 6, whole(more)},
          {"symmetric_omp", 6, 1, 0.6, 6, whole(more)},
          {"symmetric_omp", 6, 2, 0.4, 6, whole(more)},
          {"sphysics_sweep", 6, 1, 0.55, 6, whole(more)}};
}

TEST_F(report, strategies_are_ranked_against_the_gather_on_as_many_threads) {
  const json s = summary_of(field([](sample& row) { row.workspace_bytes.reset(); }));
  ASSERT_EQ(s["strategy_ladder"].size(), 6u);
  const json e = only(s["strategy_ladder"], {{"backend", "symmetric_omp"}, {"at", "most_threads"}});
  EXPECT_VALUE(e["ratio"], 1.25);
  EXPECT_VALUE(e["low"], 1.25);
  EXPECT_EQ(e["verdict"], "faster");
  EXPECT_EQ(e["base_backend"], "naive_omp");
  EXPECT_EQ(e["base_threads"], 2);
  EXPECT_VALUE(e["base_time_s"], 1.25 * 0.5 * 1.05);
  EXPECT_VALUE(e["time_s"], 1.25 * 0.4 * 1.05);
  EXPECT_EQ(e["rank"], 1);
  EXPECT_EQ(e["of"], 3);
  EXPECT_EQ(e["world"], "dam_break 2D");
  EXPECT_VALUE(e["efficiency"]["value"], 0.75);
  EXPECT_VALUE(e["efficiency"]["low"], 0.75);
  EXPECT_TRUE(e["over_serial"].is_null());
  EXPECT_TRUE(e["extra_bytes"].is_null()) << "these rows do not say it";
  EXPECT_TRUE(e["wait_share"].is_null());
  const json base = only(s["strategy_ladder"], {{"backend", "naive_omp"}, {"at", "most_threads"}});
  EXPECT_EQ(base["ratio"], 1.0);
  EXPECT_EQ(base["verdict"], "not resolved");
  const json serial = only(s["strategy_ladder"], {{"backend", "sphysics_sweep"}, {"at", "most_threads"}});
  EXPECT_EQ(serial["threads"], 1) << "a serial backend at the most threads that it has";
  EXPECT_TRUE(serial["efficiency"].is_null());
}

TEST_F(report, a_strategy_costs_on_one_thread_what_it_takes_over_the_serial_sweep) {
  const json s = summary_of(field());
  const json e = only(s["strategy_ladder"], {{"backend", "symmetric_omp"}, {"at", "one_thread"}});
  EXPECT_VALUE(e["over_serial"]["value"], 0.6 / 0.55);
  EXPECT_VALUE(e["over_serial"]["high"], 0.6 / 0.55);
  EXPECT_EQ(e["over_serial"]["rounds"], 6);
  EXPECT_TRUE(e["efficiency"].is_null());
  EXPECT_EQ(only(s["strategy_ladder"], {{"backend", "sphysics_sweep"}, {"at", "one_thread"}})["over_serial"]["value"],
            1.0);
  EXPECT_CONTAINS(text_, "1.09 [1.09, 1.09]");
}

TEST_F(report, times_of_strategies_are_those_of_all_that_gets_the_rates) {
  auto points = field();
  points[2].change = points[3].change = whole([](sample& s) { s.phases->reduce_s = *s.phases->sum_s; });
  const json s = summary_of(points);
  EXPECT_VALUE(only(s["strategy_ladder"], {{"backend", "symmetric_omp"}, {"at", "most_threads"}})["ratio"],
               1.25 * 0.5 / (2.25 * 0.4));
}

TEST_F(report, memory_of_a_strategy_is_what_it_holds_beyond_the_leanest) {
  auto points = field();
  points[1].change = holds(1000);
  points[3].change = holds(5001000);
  const json s = summary_of(points);
  const json e = only(s["strategy_ladder"], {{"backend", "symmetric_omp"}, {"at", "most_threads"}});
  EXPECT_EQ(e["workspace_bytes"], 5001000);
  EXPECT_EQ(e["extra_bytes"], 5000000);
  EXPECT_EQ(e["extra_bytes_per_particle"], 5.0);
  EXPECT_EQ(only(s["strategy_ladder"], {{"backend", "naive_omp"}, {"at", "most_threads"}})["extra_bytes"], 0);
  EXPECT_EQ(only(s["points"], {{"backend", "symmetric_omp"}, {"threads", 2}})["workspace_bytes"], 5001000);
}

TEST_F(report, strategies_over_threads_have_one_base) {
  const json s = summary_of(field(waits));
  ASSERT_EQ(s["strategy_threads"].size(), 5u);
  const json e = only(s["strategy_threads"], {{"backend", "symmetric_omp"}, {"threads", 2}});
  EXPECT_VALUE(e["ratio"], 2.5);
  EXPECT_EQ(e["base_threads"], 1);
  EXPECT_EQ(only(s["strategy_threads"], {{"backend", "naive_omp"}, {"threads", 1}})["ratio"], 1.0);
  EXPECT_EQ(only(s["strategy_ladder"], {{"backend", "naive_omp"}, {"at", "most_threads"}})["wait_share"], 0.25);
}

TEST_F(report, there_is_no_ladder_without_a_base_or_with_two_backends_or_with_phases_untimed) {
  auto points = field();
  points.erase(points.begin(), points.begin() + 2);
  EXPECT_TRUE(summary_of(points)["strategy_ladder"].empty()) << "no gather";
  std::filesystem::remove(rows_path());
  points = field();
  points.pop_back();
  EXPECT_TRUE(summary_of(points)["strategy_ladder"].empty()) << "two backends";
  std::filesystem::remove(rows_path());
  points = field();
  points[1].change = {};
  const json s = summary_of(points);
  EXPECT_TRUE(only(s["strategy_ladder"], {{"at", "most_threads"}}).is_null()) << "no time of the base";
  EXPECT_TRUE(s["strategies"].size() == 3u);
}

TEST_F(report, what_a_backend_says_of_itself_stands_in_the_strategies) {
  auto points = field();
  points.push_back({"of_another_build", 6, 1, 0.7, 6, whole()});
  const json s = summary_of(points);
  ASSERT_EQ(s["strategies"].size(), 4u);
  const json e = only(s["strategies"], {{"backend", "symmetric_omp"}});
  EXPECT_EQ(e["conflicts"], "colours");
  EXPECT_EQ(e["runtime"], "omp");
  EXPECT_EQ(e["deterministic"], true);
  EXPECT_EQ(e["symmetric"], true);
  const json unknown = only(s["strategies"], {{"backend", "of_another_build"}});
  for (const char* key : {"conflicts", "runtime", "aliases", "description", "symmetric", "deterministic"})
    EXPECT_TRUE(unknown[key].is_null()) << key;
}

}  // namespace
}  // namespace pairsum::harness

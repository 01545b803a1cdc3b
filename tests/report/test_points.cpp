#include "tests/report/report_fixture.hpp"

// What a report says of each point.
namespace pairsum::harness {
namespace {

TEST_F(report, points_have_exact_medians_and_intervals) {
  const json s = summary_of(talk());
  EXPECT_EQ(s["schema"], "pairsum.summary/2");
  EXPECT_EQ(s["title"], "talk on node");
  EXPECT_EQ(s["sources"], json({"talk/rows.jsonl"}));
  EXPECT_EQ(s["environments"], json::array({json(example::environment())}));
  EXPECT_EQ(s["points"].size(), 9u);
  EXPECT_EQ(s["series"].size(), 1u);
  EXPECT_EQ(s["rounds"]["finished"], 6);
  const json p = only(s["points"], {{"backend", "symmetric_omp"}, {"threads", 2}});
  EXPECT_EQ(p["study"], "talk");
  EXPECT_EQ(p["rounds"], 6);
  EXPECT_EQ(p["repetitions"], 1);
  EXPECT_EQ(p["steps"], 2);
  ASSERT_EQ(p["round_s"].size(), 6u);
  EXPECT_VALUE(p["round_s"][1], 0.3 * 1.2);
  EXPECT_VALUE(p["phases"]["sum_s"]["median"], 0.3 * 1.05);
  EXPECT_VALUE(p["phases"]["sum_s"]["low"], 0.3 * 0.8);
  EXPECT_VALUE(p["phases"]["sum_s"]["high"], 0.3 * 1.4);
  EXPECT_EQ(p["phases"]["sum_s"]["confidence"], 0.96875);
  EXPECT_VALUE(p["phases"]["total_s"]["median"], 2 * 0.3 * 1.05);
  EXPECT_TRUE(p["phases"]["reduce_s"]["median"].is_null());
  EXPECT_VALUE(p["ns_per_pair"], 0.3 * 1.05 * 1e9 / 2e6);
  EXPECT_EQ(p["ns_per_pair_parts"]["sum"], p["ns_per_pair"]);
  EXPECT_EQ(p["useful_pair_ratio"], 0.25);
  EXPECT_EQ(p["work"]["cells_nonempty"], 100);
  EXPECT_EQ(p["peak_rss_bytes"], 123456789);
  EXPECT_EQ(p["fingerprint"], "fedcba9876543210");
  EXPECT_TRUE(p["passes"].is_null());
  EXPECT_TRUE(p["counters"].is_null());
  EXPECT_TRUE(p["model"].is_null());
}

TEST_F(report, parts_of_the_time_per_pair_are_medians_of_their_own) {
  const auto timed = [](sample& s) {
    const std::vector<phases> times{{1.0, 0.25, 0.125, 2.00, 0.00, 1.0, 8.0},
                                    {1.0, 0.50, 0.125, 1.00, 0.50, 1.0, 8.0},
                                    {1.0, 0.75, 0.125, 1.25, 0.25, 1.0, 8.0}};
    s.phases = times[static_cast<std::size_t>(s.round - 1)];
    if (s.point.backend == "naive") s.work.reset();
    if (s.point.backend == "symmetric" && s.round == 2) s.phases->reduce_s.reset();
  };
  const json s =
      summary_of({{"naive", 6, 1, 1, 3, timed}, {"pair_list", 6, 1, 1, 3, timed}, {"symmetric", 6, 1, 1, 3, timed}}, 3);
  // 2 million pairs: 500 ns per second. All four take 2.375, 2.125 and 2.375 s.
  const json list = only(s["points"], {{"backend", "pair_list"}});
  EXPECT_EQ(list["ns_per_pair_parts"],
            json({{"prepare", 250.0}, {"zero", 62.5}, {"sum", 625.0}, {"reduce", 125.0}, {"all", 1187.5}}));
  EXPECT_EQ(list["ns_per_pair"], 625.0);
  const json untimed = only(s["points"], {{"backend", "symmetric"}});
  EXPECT_EQ(untimed["ns_per_pair_parts"],
            json({{"prepare", 250.0}, {"zero", 62.5}, {"sum", 625.0}, {"reduce", nullptr}, {"all", nullptr}}));
  const json uncounted = only(s["points"], {{"backend", "naive"}});
  EXPECT_TRUE(uncounted["ns_per_pair"].is_null());
  EXPECT_EQ(uncounted["ns_per_pair_parts"].size(), 5u);
  for (const json& part : uncounted["ns_per_pair_parts"]) EXPECT_TRUE(part.is_null());
}

TEST_F(report, scatter_is_told_apart_between_and_within_rounds) {
  row_writer writer(rows_path());
  writer.write(example::environment());
  for (int round = 1; round <= 2; ++round) {
    for (int repetition = 1; repetition <= 2; ++repetition) {
      sample s = synthetic::step({"naive", 6, 1, 1.0}, round, 1);
      s.repetition = repetition;
      synthetic::set_times(s, 10 * round + (repetition == 1 ? -1 : 1));  // 9, 11 and 19, 21
      write_sample(writer, s);
    }
    writer.write(synthetic::closing(round, 2));
  }
  const json p = make()["points"].at(0);
  EXPECT_EQ(p["repetitions"], 2);
  EXPECT_VALUE(p["variance"]["within"], std::sqrt(2.0) / 15);
  EXPECT_VALUE(p["variance"]["between"], 7.0 / 15);  // the square root of (100 - 2) / 2, over the mean
}

TEST_F(report, one_repetition_a_round_says_nothing_of_the_scatter_within) {
  const json p = summary_of({{"naive", 6, 1, 1.0}})["points"].at(0);
  EXPECT_TRUE(p["variance"]["within"].is_null());
  EXPECT_GT(p["variance"]["between"].get<double>(), 0.1);
}

TEST_F(report, passes_and_counters_are_means_over_the_steps) {
  const auto with_passes = [](sample& s) {
    const double f = s.step;
    s.threads_busy_s = thread_times{{0.25 * f, 0.5 * f}, {0.125 * f, 0.0}};
    s.barrier_wait_s = thread_times{{0.125 * f, 0.0}, {0.0, 0.5 * f}};
    s.counters = counters_row{1000u * static_cast<unsigned>(s.step), 2000, std::nullopt};
    if (s.round == 2) s.counters->instructions.reset();
  };
  const json p = summary_of({{"symmetric_omp", 6, 2, 1.0, 6, with_passes}})["points"].at(0);
  EXPECT_EQ(p["passes"]["busy_s"], json({{0.375, 0.75}, {0.1875, 0.0}}));
  EXPECT_EQ(p["passes"]["barrier_wait_s"], json({{0.1875, 0.0}, {0.0, 0.75}}));
  EXPECT_VALUE(p["passes"]["wait_share"], 0.625 / 1.5);
  EXPECT_EQ(p["counters"], json({{"cycles", 1500}, {"instructions", 2000}, {"cache_misses", nullptr}}));
  EXPECT_CONTAINS(text_, "41.7 %");
}

}  // namespace
}  // namespace pairsum::harness

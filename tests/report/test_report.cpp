#include "tests/report/report_fixture.hpp"

namespace pairsum::harness {
namespace {

TEST_F(report, points_have_exact_medians_and_intervals) {
  write_all();
  const json s = make();
  EXPECT_EQ(s["schema"], "pairsum.summary/1");
  EXPECT_EQ(s["sources"], json({"talk/rows.jsonl"}));
  EXPECT_EQ(s["environments"], json::array({json(example::environment())}));
  EXPECT_EQ(s["points"].size(), 9u);
  EXPECT_EQ(s["series"].size(), 1u);
  const json p = only(s["points"], {{"backend", "symmetric_omp"}, {"threads", 2}});
  EXPECT_EQ(p["study"], "talk");
  EXPECT_EQ(p["repetitions"], 6);
  EXPECT_EQ(p["steps"], 2);
  EXPECT_NEAR(p["phases"]["sum_s"]["median"].get<double>(), 0.3 * 1.05, 1e-15);
  EXPECT_NEAR(p["phases"]["sum_s"]["low"].get<double>(), 0.3 * 0.8, 1e-15);
  EXPECT_NEAR(p["phases"]["sum_s"]["high"].get<double>(), 0.3 * 1.4, 1e-15);
  EXPECT_EQ(p["phases"]["sum_s"]["confidence"], 0.96875);
  EXPECT_NEAR(p["phases"]["total_s"]["median"].get<double>(), 2 * 0.3 * 1.05, 1e-15);
  EXPECT_TRUE(p["phases"]["reduce_s"]["median"].is_null());
  EXPECT_NEAR(p["ns_per_pair"].get<double>(), 0.3 * 1.05 * 1e9 / 2e6, 1e-9);
  EXPECT_EQ(p["ns_per_pair_parts"]["sum"], p["ns_per_pair"]);
  EXPECT_EQ(p["useful_pair_ratio"], 0.25);
  EXPECT_EQ(p["work"]["cells_nonempty"], 100);
  EXPECT_EQ(p["peak_rss_bytes"], 123456789);
  EXPECT_EQ(p["fingerprint"], "fedcba9876543210");
}

TEST_F(report, parts_of_the_time_per_pair_are_medians_of_their_own) {
  const std::vector<phases> times{{1.0, 0.25, 0.125, 2.00, 0.00, 1.0, 8.0},
                                  {1.0, 0.50, 0.125, 1.00, 0.50, 1.0, 8.0},
                                  {1.0, 0.75, 0.125, 1.25, 0.25, 1.0, 8.0}};
  row_writer writer(rows_path());
  writer.write(example::environment());
  for (const char* backend : {"naive", "pair_list", "symmetric"})
    for (int repetition = 1; repetition <= 3; ++repetition) {
      sample s = synthetic::step(backend, 6, 1, 1.0, repetition, 1);
      s.phases = times[static_cast<std::size_t>(repetition - 1)];
      if (s.point.backend == "naive") s.work.reset();
      if (s.point.backend == "symmetric" && repetition == 2) s.phases->reduce_s.reset();
      writer.write(s);
    }
  const json s = make();
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

TEST_F(report, speedups_are_paired_and_name_their_base) {
  write_all();
  const json s = make();
  const json e = only(s["speedup"], {{"backend", "symmetric_tbb"}, {"threads", 2}});
  EXPECT_NEAR(e["speedup"].get<double>(), 2.5, 1e-12);
  EXPECT_NEAR(e["low"].get<double>(), 2.5, 1e-12);
  EXPECT_NEAR(e["high"].get<double>(), 2.5, 1e-12);
  EXPECT_NEAR(e["efficiency"].get<double>(), 1.25, 1e-12);
  EXPECT_EQ(e["base_backend"], "symmetric_tbb");
  EXPECT_EQ(e["base_threads"], 1);
  EXPECT_NEAR(e["base_time_s"].get<double>(), 0.5 * 1.05, 1e-15);
  EXPECT_NEAR(e["time_s"].get<double>(), 0.2 * 1.05, 1e-15);
  EXPECT_EQ(only(s["speedup"], {{"backend", "symmetric_tbb"}, {"threads", 1}})["speedup"], 1.0);
  const json few = only(s["speedup"], {{"backend", "symmetric_tbb"}, {"threads", 4}});
  EXPECT_NEAR(few["speedup"].get<double>(), 2.5, 1e-12);
  EXPECT_NEAR(few["low"].get<double>(), 2.5, 1e-12) << "three pairs suffice";
  EXPECT_TRUE(only(s["speedup"], {{"backend", "naive"}, {"M", 6}}).is_null());
}

TEST_F(report, algorithm_speedups_compare_naive_with_symmetric) {
  write_all();
  const json s = make();
  EXPECT_EQ(s["algorithm_speedup"].size(), 3u);
  const json e = only(s["algorithm_speedup"], {{"runtime", "serial"}, {"base_M", 7}});
  EXPECT_NEAR(e["speedup"].get<double>(), 1.6, 1e-12);
  EXPECT_NEAR(e["low"].get<double>(), 1.6, 1e-12);
  EXPECT_EQ(e["backend"], "symmetric");
  EXPECT_EQ(e["M"], 6);
  EXPECT_EQ(e["base_backend"], "naive");
  EXPECT_NEAR(e["base_time_s"].get<double>(), 0.8 * 1.05, 1e-15);
  const json six = only(s["algorithm_speedup"], {{"runtime", "serial"}, {"base_M", 6}});
  EXPECT_NEAR(six["speedup"].get<double>(), 2.0, 1e-12);
  const json omp = only(s["algorithm_speedup"], {{"runtime", "omp"}});
  EXPECT_NEAR(omp["speedup"].get<double>(), 2.0, 1e-12);
  EXPECT_EQ(omp["threads"], 2);
}

TEST_F(report, openmp_is_compared_with_tbb) {
  write_all();
  const json s = make();
  EXPECT_EQ(s["runtime_comparison"].size(), 2u);
  const json two = only(s["runtime_comparison"], {{"algorithm", "symmetric"}, {"threads", 2}});
  EXPECT_NEAR(two["ratio"].get<double>(), 1.5, 1e-12);
  EXPECT_NEAR(two["low"].get<double>(), 1.5, 1e-12);
  EXPECT_CONTAINS(text_, "not resolved\n");  // the same time on 1 thread
}

TEST_F(report, m_comparison_has_times_and_work) {
  write_all();
  const json s = make();
  const json e = only(s["m_comparison"], {{"backend", "naive"}, {"M", 7}});
  EXPECT_NEAR(e["time_s"].get<double>(), 0.8 * 1.05, 1e-15);
  EXPECT_NEAR(e["total_s"].get<double>(), 1.6 * 1.05, 1e-15);
  EXPECT_EQ(e["cells"], 1000);
  EXPECT_EQ(e["cells_nonempty"], 100);
  EXPECT_EQ(e["pairs_tested"], 8000000);
  EXPECT_EQ(e["pairs_interacting"], 2000000);
  EXPECT_EQ(e["useful_pair_ratio"], 0.25);
}

TEST_F(report, caveats_are_said) {
  write_all();
  {
    row_writer writer(rows_path());
    write_point(writer, "coloured_omp", 6, 2, 0.4);
  }
  const json s = make();
  EXPECT_TRUE(has_caveat(s, "more threads than cores: symmetric_tbb M=6 threads=4"));
  EXPECT_TRUE(has_caveat(s, "fewer than 6 repetitions, so no interval: symmetric_tbb M=6 threads=4"));
  EXPECT_TRUE(has_caveat(s, "no speedup, the base on 1 thread is missing: coloured_omp M=6 threads=2"));
  EXPECT_TRUE(has_caveat(s, "the base on 1 thread is missing: coloured_omp M=6 threads=2, naive_omp M=6 threads=2"));
  EXPECT_TRUE(has_caveat(s, "uncommitted changes"));
  EXPECT_TRUE(only(s["speedup"], {{"backend", "coloured_omp"}}).is_null());
  EXPECT_CONTAINS(text_, "- more threads than cores: ");
}

}  // namespace
}  // namespace pairsum::harness

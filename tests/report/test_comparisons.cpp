#include "tests/report/report_fixture.hpp"

// Ratios between points.
namespace pairsum::harness {
namespace {

TEST_F(report, speedups_are_paired_and_name_their_base) {
  const json s = summary_of(talk());
  const json e = only(s["speedup"], {{"backend", "symmetric_tbb"}, {"threads", 2}});
  EXPECT_VALUE(e["speedup"], 2.5);
  EXPECT_VALUE(e["low"], 2.5);
  EXPECT_VALUE(e["high"], 2.5);
  EXPECT_VALUE(e["efficiency"], 1.25);
  EXPECT_EQ(e["confidence"], 0.95);
  EXPECT_EQ(e["rounds"], 6);
  EXPECT_EQ(e["verdict"], "faster");
  EXPECT_EQ(e["base_backend"], "symmetric_tbb");
  EXPECT_EQ(e["base_threads"], 1);
  EXPECT_VALUE(e["base_time_s"], 0.5 * 1.05);
  EXPECT_VALUE(e["time_s"], 0.2 * 1.05);
  EXPECT_TRUE(e["machine_flops_scaling"].is_null());
  const json base = only(s["speedup"], {{"backend", "symmetric_tbb"}, {"threads", 1}});
  EXPECT_EQ(base["speedup"], 1.0);
  EXPECT_EQ(base["verdict"], "not resolved");
  const json few = only(s["speedup"], {{"backend", "symmetric_tbb"}, {"threads", 4}});
  EXPECT_VALUE(few["speedup"], 2.5);
  EXPECT_EQ(few["rounds"], 5);
  EXPECT_VALUE(few["low"], 2.5) << "three rounds suffice";
  EXPECT_TRUE(only(s["speedup"], {{"backend", "naive"}, {"M", 6}}).is_null());
}

TEST_F(report, algorithm_speedups_compare_naive_with_symmetric) {
  const json s = summary_of(talk());
  EXPECT_EQ(s["algorithm_speedup"].size(), 3u);
  const json e = only(s["algorithm_speedup"], {{"runtime", "serial"}, {"base_M", 7}});
  EXPECT_VALUE(e["speedup"], 1.6);
  EXPECT_VALUE(e["low"], 1.6);
  EXPECT_EQ(e["backend"], "symmetric");
  EXPECT_EQ(e["M"], 6);
  EXPECT_EQ(e["base_backend"], "naive");
  EXPECT_VALUE(e["base_time_s"], 0.8 * 1.05);
  EXPECT_VALUE(only(s["algorithm_speedup"], {{"runtime", "serial"}, {"base_M", 6}})["speedup"], 2.0);
  const json omp = only(s["algorithm_speedup"], {{"runtime", "omp"}});
  EXPECT_VALUE(omp["speedup"], 2.0);
  EXPECT_EQ(omp["threads"], 2);
}

TEST_F(report, openmp_is_compared_with_tbb) {
  const json s = summary_of(talk());
  EXPECT_EQ(s["runtime_comparison"].size(), 2u);
  const json two = only(s["runtime_comparison"], {{"algorithm", "symmetric"}, {"threads", 2}});
  EXPECT_VALUE(two["ratio"], 1.5);
  EXPECT_VALUE(two["low"], 1.5);
  EXPECT_EQ(two["verdict"], "faster");
  EXPECT_EQ(only(s["runtime_comparison"], {{"threads", 1}})["verdict"], "not resolved") << "the same time";
  EXPECT_CONTAINS(text_, "not resolved\n");
}

TEST_F(report, m_comparison_has_times_and_work) {
  const json s = summary_of(talk());
  const json e = only(s["m_comparison"], {{"backend", "naive"}, {"M", 7}});
  EXPECT_VALUE(e["time_s"], 0.8 * 1.05);
  EXPECT_VALUE(e["low"], 0.8 * 0.8);
  EXPECT_VALUE(e["high"], 0.8 * 1.4);
  EXPECT_VALUE(e["total_s"], 1.6 * 1.05);
  EXPECT_EQ(e["cells"], 1000);
  EXPECT_EQ(e["cells_nonempty"], 100);
  EXPECT_EQ(e["pairs_tested"], 8000000);
  EXPECT_EQ(e["pairs_interacting"], 2000000);
  EXPECT_EQ(e["useful_pair_ratio"], 0.25);
  EXPECT_EQ(e["collision_share"], 0.25);  // 6 of 8 million tests without folding
  EXPECT_EQ(e["best_M"], 7);
  EXPECT_EQ(e["over_best"], 1.0);
  EXPECT_EQ(e["verdict"], "not resolved");
  const json six = only(s["m_comparison"], {{"backend", "naive"}, {"M", 6}});
  EXPECT_EQ(six["best_M"], 7);
  EXPECT_VALUE(six["over_best"], 1.25);
  EXPECT_EQ(six["verdict"], "slower");
}

TEST_F(report, what_was_not_counted_is_null) {
  const auto old = [](sample& s) {
    if (s.work) s.work->pairs_tested_unfolded.reset();
  };
  const json s = summary_of({{"naive", 6, 1, 1.0, 6, old}});
  EXPECT_TRUE(s["m_comparison"][0]["collision_share"].is_null());
}

TEST_F(report, backends_are_compared_with_their_fastest_granularity) {
  const auto with = [](const char* g) { return [g](sample& s) { s.point.granularity = g; }; };
  const json s = summary_of({{"naive_omp", 6, 2, 0.9, 6, with("dynamic:1")},
                             {"naive_omp", 6, 2, 0.6, 6, with("dynamic:32")},
                             {"symmetric_omp", 6, 2, 0.3, 6, with("static:0")},
                             {"symmetric_omp", 6, 2, 0.4, 6, with("dynamic:32")},
                             {"symmetric_tbb", 6, 2, 0.5, 6, with("auto:1")},
                             {"symmetric_tbb", 6, 2, 0.2, 6, with("simple:8")}});
  ASSERT_EQ(s["algorithm_speedup"].size(), 1u);
  EXPECT_VALUE(s["algorithm_speedup"][0]["speedup"], 2.0);
  EXPECT_EQ(s["algorithm_speedup"][0]["base_granularity"], "dynamic:32");
  EXPECT_EQ(s["algorithm_speedup"][0]["granularity"], "static:0");
  ASSERT_EQ(s["runtime_comparison"].size(), 1u);
  EXPECT_VALUE(s["runtime_comparison"][0]["ratio"], 1.5);
  EXPECT_EQ(s["runtime_comparison"][0]["tbb_granularity"], "simple:8");
  EXPECT_CONTAINS(text_, "symmetric_omp static:0 M=6");
}

TEST_F(report, caveats_are_said) {
  auto points = talk();
  points.push_back({"coloured_omp", 6, 2, 0.4});
  const json s = summary_of(points);
  EXPECT_TRUE(has_caveat(s, "more threads than cores: symmetric_tbb M=6 threads=4"));
  EXPECT_TRUE(has_caveat(s, "fewer than 6 rounds, so no interval of the median: symmetric_tbb M=6 threads=4"));
  EXPECT_TRUE(has_caveat(s, "no speedup over 1 thread, which was not measured: coloured_omp M=6 threads=2, naive_omp"));
  EXPECT_TRUE(has_caveat(s, "uncommitted changes"));
  EXPECT_TRUE(only(s["speedup"], {{"backend", "coloured_omp"}}).is_null());
  EXPECT_CONTAINS(text_, "- more threads than cores: ");
}

}  // namespace
}  // namespace pairsum::harness

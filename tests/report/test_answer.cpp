#include "tests/report/report_fixture.hpp"

// Which backend the report recommends.
namespace pairsum::harness {
namespace {

/// A step of which the sum is a fixed part only.
std::function<void(sample&)> with_total(double total_s) {
  return [total_s](sample& s) { s.phases->total_s = total_s * synthetic::disturbance(s.round); };
}

TEST_F(report, the_answer_is_the_fastest_whole_step) {
  const json a = summary_of({{"naive_omp", 7, 2, 1.0, 6, with_total(1.5)},
                             {"naive_omp", 6, 2, 1.0, 6, with_total(1.6)},
                             {"naive_omp", 7, 1, 1.0, 6, with_total(1.4)},
                             {"pair_list_omp", 7, 2, 0.1, 6, with_total(2.0)},  // the shortest sum
                             {"symmetric_omp", 7, 2, 0.6, 6, with_total(1.0)}})["answer"];
  EXPECT_EQ(a["backend"], "symmetric_omp");
  EXPECT_EQ(a["M"], 7);
  EXPECT_EQ(a["threads"], 2);
  EXPECT_EQ(a["granularity"], "dynamic:32");
  EXPECT_VALUE(a["time_s"], 1.05);
  EXPECT_EQ(a["base_backend"], "naive_omp");
  EXPECT_EQ(a["base_M"], 7);
  EXPECT_EQ(a["base_threads"], 2) << "as many threads";
  EXPECT_VALUE(a["base_time_s"], 1.575);
  EXPECT_VALUE(a["speedup"], 1.5);
  EXPECT_VALUE(a["low"], 1.5);
  EXPECT_EQ(a["confidence"], 0.95);
  EXPECT_TRUE(a["ties"].empty());
  EXPECT_EQ(
      a["text"],
      "On node take symmetric_omp with M = 7 and 2 threads: 1.50 times [1.50, 1.50] as fast as naive_omp with M = 7 "
      "and 2 threads.");
  EXPECT_EQ(
      a["details"],
      "On node (some model, 2 cores) a whole step of 1000000 fluid particles (dx 0.00594, rest, double, ferrari09) "
      "takes 1050.0 ms, with naive_omp with M = 7 and 2 threads 1575.0 ms.");
  EXPECT_EQ(text_.find("On node take symmetric_omp"), 0u) << "first of all";
}

TEST_F(report, points_that_cannot_be_told_from_the_best_are_named) {
  const json a =
      summary_of({{"naive_omp", 7, 2, 1.0}, {"symmetric_omp", 7, 2, 0.5}, {"symmetric_omp", 6, 2, 0.5}})["answer"];
  EXPECT_EQ(a["M"], 6);
  EXPECT_EQ(a["ties"], json::array({{{"backend", "symmetric_omp"},
                                     {"grid", "hashed_grid"},
                                     {"M", 7},
                                     {"threads", 2},
                                     {"granularity", "dynamic:32"},
                                     {"isa", "scalar"},
                                     {"block", "none"}}}));
  EXPECT_CONTAINS(a["details"].get<std::string>(),
                  "No difference was resolved from symmetric_omp with M = 7 and 2 threads.");
}

TEST_F(report, a_grid_without_M_is_named_in_its_place) {
  const auto compact = [](sample& s) { s.point.grid = "compact_grid"; };
  const auto wide = [](sample& s) { s.point.grid = "compact_grid", s.point.block = "slab:4"; };
  const json s = summary_of({{"naive_omp", 7, 2, 1.0},
                             {"symmetric_omp", 0, 1, 0.9, 6, compact},
                             {"symmetric_omp", 0, 2, 0.5, 6, compact},
                             {"symmetric_omp", 0, 2, 0.7, 6, wide}});
  const json& a = s["answer"];
  EXPECT_TRUE(a["M"].is_null());
  EXPECT_EQ(a["grid"], "compact_grid");
  EXPECT_CONTAINS(a["text"].get<std::string>(), "take symmetric_omp none on compact_grid and 2 threads: 2.00 times");
  EXPECT_EQ(s["m_comparison"].size(), 1u) << "of those with an M";
  EXPECT_CONTAINS(text_, "symmetric_omp/compact_grid slab:4  -");
  EXPECT_CONTAINS(text_, "M=7");
  EXPECT_EQ(text_.find("M=0"), std::string::npos) << text_;
  EXPECT_EQ(text_.find("M = 0"), std::string::npos) << text_;
}

TEST_F(report, the_naive_backend_can_be_the_best_itself) {
  const json a = summary_of({{"naive", 7, 1, 0.5}, {"symmetric", 7, 1, 1.0}})["answer"];
  EXPECT_EQ(a["backend"], "naive");
  EXPECT_EQ(a["base_backend"], "naive");
  EXPECT_EQ(a["speedup"], 1.0);
  EXPECT_EQ(a["text"], "On node take naive with M = 7 and 1 thread.");
  EXPECT_CONTAINS(a["details"].get<std::string>(), "It is the fastest naive backend itself.");
}

TEST_F(report, without_a_naive_backend_that_is_said) {
  const json a = summary_of({{"symmetric", 7, 1, 1.0}})["answer"];
  EXPECT_EQ(a["base_backend"], "symmetric");
  EXPECT_CONTAINS(a["details"].get<std::string>(), "no naive backend was measured beside it");
}

TEST_F(report, the_largest_problem_is_answered_for) {
  const auto small = [](sample& s) { s.point.n_fluid = 1000; };
  const json s =
      summary_of({{"naive", 6, 1, 0.001, 6, small}, {"naive", 7, 1, 0.001, 6, small}, {"symmetric", 7, 1, 1.0}});
  EXPECT_EQ(s["answer"]["backend"], "symmetric");
  EXPECT_EQ(s["series"][s["answer"]["series"].get<std::size_t>()]["n_fluid"], 1000000);
}

TEST_F(report, self_test_backends_are_no_answer) {
  const json s = summary_of({{"again_naive_omp", 7, 2, 1.0}, {"slowed_5_naive_omp", 7, 2, 1.0}});
  EXPECT_TRUE(s["answer"].is_null());
  EXPECT_TRUE(s["questions"].empty());
}

TEST_F(report, an_untimed_total_is_no_answer) {
  const auto untimed = [](sample& s) { s.phases->total_s.reset(); };
  EXPECT_TRUE(summary_of({{"naive", 7, 1, 1.0, 6, untimed}})["answer"].is_null());
}

}  // namespace
}  // namespace pairsum::harness

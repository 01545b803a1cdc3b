#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "harness/report/text_table.hpp"
#include "tests/report/made_builds.hpp"

namespace pairsum::harness {
namespace {

TEST(text_table, columns_are_aligned) {
  text_table table({"name", "x"}, 1);
  table.add({"a", "1.5"});
  table.add({"longer", "10.25"});
  table.add({"b"});
  EXPECT_EQ(table.text(),
            "name        x\n"
            "a         1.5\n"
            "longer  10.25\n"
            "b\n");
}

TEST(text_table, long_texts_are_wrapped) {
  EXPECT_EQ(wrapped("one two three", 8), "one two\n    three\n");
  EXPECT_EQ(wrapped("short"), "short\n");
}

TEST(text_table, milliseconds) {
  EXPECT_EQ(ms(0.0123456), "12.346");
  EXPECT_EQ(ms(0.0000123), "0.0123");
  EXPECT_EQ(ms(12.3456), "12346");
  EXPECT_EQ(ms(std::nan("")), "-");
}

/// Everything at once: all kinds of backends, two builds, self-tests, a failed point.
std::vector<made_point> everything() {
  std::vector<made_point> points;
  for (const char* runtime : {"", "_omp", "_tbb"})
    for (const char* algorithm : {"naive", "symmetric", "pair_list", "coloured"})
      for (const int M : {6, 7})
        for (const int threads : {1, 2, 4, 8, 16})
          if (*runtime != '\0' || threads == 1)
            points.push_back({algorithm + std::string(runtime), M, threads, 12.5 / threads, 6, [](sample& s) {
                                s.threads_busy_s = thread_times{{0.5, 0.25}};
                                s.barrier_wait_s = thread_times{{0.0, 0.25}};
                              }});
  points.push_back({"slowed_20_symmetric_omp", 7, 2, 12.5});
  points.push_back({"corrupt_symmetric_omp", 7, 2, 1.0, 6, [](sample& s) {
                      s.phases.reset();
                      s.error = "particle 7: relative error 0.5 above its bound 1e-14, and so it goes on for a while";
                    }});
  return points;
}

TEST_F(report, text_tables_fit_120_columns_and_say_what_they_show) {
  const environment_row gcc = synthetic::build('1', "GNU 12.2.0"), clang = synthetic::build('2', "Clang 14.0.6");
  std::vector<made_point> points;
  for (const made_point& p : everything()) points.push_back(synthetic::by(gcc, p));
  points.push_back(synthetic::by(clang, {"naive", 6, 1, 12.0}));
  synthetic::write_builds(rows_path(), {gcc, clang}, points);
  make();
  std::istringstream lines(text_);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
  for (const char* heading :
       {"On node (some model", "\nIs the symmetric sum twice",
        "\n== dam_break, rest, dx 0.00594: ", "\nSummation time per step: ", "\nAlgorithm speedup: ",
        "\nOpenMP against TBB: ", "\nComparison over M: ", "\nAgainst the least time",
        "\nPhases per step: ", "\nBuilds: ", "\nSelf-test: ", "\nFailed points: ", "\nCaveats: "})
    EXPECT_CONTAINS("\n" + text_, heading);
  EXPECT_CONTAINS(text_, "threads 16");
  EXPECT_CONTAINS(text_, "[   10000,    17500]");
}

}  // namespace
}  // namespace pairsum::harness

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "harness/report/report.hpp"
#include "harness/report/text_table.hpp"
#include "tests/report/synthetic.hpp"
#include "tests/rows/scratch.hpp"

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

class tables : public scratch {};

TEST_F(tables, fit_120_columns_and_say_what_they_show) {
  const auto path = file("talk/rows.jsonl");
  {
    row_writer writer(path);
    writer.write(example::environment());
    for (const char* runtime : {"", "_omp", "_tbb"})
      for (const char* algorithm : {"naive", "symmetric", "pair_list", "coloured"})
        for (const int M : {6, 7})
          for (const int threads : {1, 2, 4, 8, 16}) {
            if (*runtime == '\0' && threads > 1) continue;
            synthetic::write_point(writer, algorithm + std::string(runtime), M, threads, 12.5 / threads);
          }
  }
  const std::string text = make_report({path}, {file("summary.json"), false});
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
  for (const char* heading :
       {"== dam_break, rest, dx 0.00594: ", "\nSummation time per step: ", "\nAlgorithm speedup: ",
        "\nOpenMP against TBB: ", "\nComparison over M: ", "\nPhases per step: ", "\nCaveats: "})
    EXPECT_CONTAINS("\n" + text, heading);
  EXPECT_CONTAINS(text, "threads 16");
  EXPECT_CONTAINS(text, "[   10000,    17500]");
}

}  // namespace
}  // namespace pairsum::harness

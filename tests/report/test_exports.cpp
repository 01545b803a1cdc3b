#include <algorithm>
#include <sstream>

#include "harness/report/tables.hpp"
#include "harness/report/text_table.hpp"
#include "tests/report/report_fixture.hpp"

// Tables for other programs.
namespace pairsum::harness {
namespace {

TEST(csv, columns_are_the_keys_of_all_entries) {
  const json entries = json::array({{{"b", 1}, {"a", {{"x", 2.5}, {"y", nullptr}}}}, {{"b", 2}, {"c", true}}});
  EXPECT_EQ(print_csv(entries), "a.x,a.y,b,c\n2.5,,1,\n,,2,true\n");
}

TEST(csv, lists_are_left_out) { EXPECT_EQ(print_csv(json::array({{{"list", {1, 2}}, {"n", 1}}})), "n\n1\n"); }

TEST(csv, cells_are_quoted_where_needed) {
  const json entries = json::array({{{"k", "plain"}}, {{"k", "a,b"}}, {{"k", "say \"x\""}}, {{"k", "two\nlines"}}});
  EXPECT_EQ(print_csv(entries), "k\nplain\n\"a,b\"\n\"say \"\"x\"\"\"\n\"two\nlines\"\n");
  EXPECT_EQ(print_csv(json::array({{{"a,b", 1}}})), "\"a,b\"\n1\n");
}

TEST(csv, numbers_lose_no_digit) {
  EXPECT_EQ(print_csv(json::array({{{"t", 0.1 + 0.2}}})), "t\n0.30000000000000004\n");
}

TEST(markdown, pipes_in_cells_are_escaped) {
  text_table table({"name", "a|b"}, 1);
  table.add({"x|y", "1"});
  table.add({"z"});
  EXPECT_EQ(table.markdown(), "| name | a\\|b |\n|---|---:|\n| x\\|y | 1 |\n| z |  |\n");
}

std::size_t cells_of(const std::string& line) {
  std::size_t pipes = 0;
  for (std::size_t i = 0; i < line.size(); ++i) pipes += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
  return pipes - 1;
}

/// Complains of a text whose tables are not a header, a rule and rows of as many cells, after an empty line.
std::string table_fault(const std::string& text) {
  std::istringstream lines(text);
  std::string before = "x";
  std::size_t columns = 0, row = 0;
  for (std::string line; std::getline(lines, line); before = line) {
    if (!line.starts_with('|')) {
      if (row == 1) return "a header without a rule: " + before;
      row = 0;
      continue;
    }
    if (++row == 1) {
      columns = cells_of(line);
      if (!before.empty()) return "no empty line before " + line;
    }
    if (row == 2 && line.find_first_not_of("|-:") != line.npos) return "no rule: " + line;
    if (cells_of(line) != columns) return "another number of cells: " + line;
  }
  return "";
}

TEST(markdown, the_check_rejects) {
  EXPECT_EQ(table_fault("\n| a | b |\n|---|---:|\n| 1 | 2 |\n"), "");
  EXPECT_NE(table_fault("text\n| a |\n|---|\n"), "");
  EXPECT_NE(table_fault("\n| a | b |\n| 1 | 2 |\n"), "");
  EXPECT_NE(table_fault("\n| a | b |\n|---|---|\n| 1 |\n"), "");
  EXPECT_NE(table_fault("\n| a |\n\n"), "");
}

TEST_F(report, tables_are_written_as_markdown) {
  summary_of(talk());
  const std::string text = get(file("out/tables.md"));
  EXPECT_EQ(text.find("# talk on node\n\nOn node"), 0u) << text;
  EXPECT_EQ(table_fault(text), "") << text;
  EXPECT_CONTAINS(text, "\n## dam_break, rest, dx 0.00594\n\n1000000 fluid and 1014966 boundary particles; ");
  EXPECT_CONTAINS(text,
                  "\n| backend | M | threads | sum ms | [low, high] | speedup | efficiency | ns/pair | rounds |\n");
  EXPECT_CONTAINS(text, "\n| symmetric_tbb | 6 | 2 | 210.00 | [160.00, 280.00] | 2.50 | 125.0 % | 105.000 | 6 |\n");
  EXPECT_CONTAINS(text, "\n```text\nCaveats: ");
}

TEST_F(report, tables_are_written_as_csv) {
  const json s = summary_of(talk());
  const std::string text = get(file("out/csv/speedup.csv"));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(text, '\n')), s["speedup"].size() + 1);
  EXPECT_EQ(text.find("M,backend,base_backend,base_threads,base_time_s,block,case,confidence,dx,efficiency,"), 0u)
      << text;
  EXPECT_CONTAINS(get(file("out/csv/points.csv")), ",phases.sum_s.median,");
  EXPECT_EQ(get(file("out/tables.txt")), text_);
}

}  // namespace
}  // namespace pairsum::harness

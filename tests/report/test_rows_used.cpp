#include <set>

#include "tests/report/report_fixture.hpp"

// Which rows enter a report.
namespace pairsum::harness {
namespace {

TEST_F(report, unverified_rows_are_listed_and_in_no_table) {
  auto points = talk();
  points.push_back({"wrong_omp", 6, 2, 0.1, 6, [](sample& s) {
                      s.error = "particle 7 is off";
                      s.phases.reset();
                    }});
  points.push_back({"unsure_omp", 6, 2, 0.1, 6, [](sample& s) { s.verify.fingerprint.reset(); }});
  // One bad step takes its whole round away, and only that.
  points[0].change = [](sample& s) {
    if (s.round == 6 && s.step == 2) s.verify.fingerprint.reset();
  };
  const json s = summary_of(points);
  EXPECT_EQ(s["points"].size(), 9u);
  ASSERT_EQ(s["failed"].size(), 3u);
  EXPECT_EQ(only(s["failed"], {{"backend", "wrong_omp"}})["error"], "particle 7 is off");
  EXPECT_EQ(only(s["failed"], {{"backend", "wrong_omp"}})["rows"], 12);
  EXPECT_EQ(only(s["failed"], {{"backend", "unsure_omp"}})["error"], "not verified");
  EXPECT_EQ(only(s["failed"], {{"backend", "naive"}})["rows"], 1);
  const json naive = only(s["points"], {{"backend", "naive"}, {"M", 6}});
  EXPECT_EQ(naive["rounds"], 5);
  EXPECT_VALUE(naive["phases"]["sum_s"]["median"], 1.0);
  EXPECT_EQ(s["m_comparison"].size(), 9u);
  const std::size_t failed = text_.find("Failed points");
  ASSERT_NE(failed, std::string::npos);
  EXPECT_GT(text_.find("wrong_omp"), failed);
  EXPECT_GT(text_.find("unsure_omp"), failed);
}

TEST_F(report, void_and_unfinished_rounds_do_not_count) {
  {
    row_writer writer(rows_path());
    writer.write(example::environment());
    synthetic::write_rounds(writer, talk());
    synthetic::write_round(writer, 7, {{"naive", 6, 1, 1000.0, 9}});
    void_row v = example::voided();
    v.round = 7;
    writer.write(v);
    synthetic::write_round(writer, 8, {{"naive", 6, 1, 1000.0, 9}}, false);
  }
  const json s = make();
  EXPECT_EQ(only(s["points"], {{"backend", "naive"}, {"M", 6}})["rounds"], 6);
  EXPECT_EQ(s["rounds"]["finished"], 6);
  EXPECT_EQ(s["rounds"]["void"], 1);
}

TEST_F(report, points_of_different_rounds_are_compared_unpaired) {
  {
    row_writer writer(rows_path());
    writer.write(example::environment());
    for (int round = 1; round <= 6; ++round) {
      write_sample(writer, synthetic::step({"naive", 6, 1, 1.0}, round, 1));
      writer.write(synthetic::closing(round, 1));
    }
    for (int round = 7; round <= 12; ++round) {
      write_sample(writer, synthetic::step({"symmetric", 6, 1, 0.5}, round, 1));
      writer.write(synthetic::closing(round, 1));
    }
  }
  const json s = make();
  ASSERT_EQ(s["algorithm_speedup"].size(), 1u);
  EXPECT_VALUE(s["algorithm_speedup"][0]["speedup"], 2.0);
  EXPECT_EQ(s["algorithm_speedup"][0]["rounds"], 0);
  EXPECT_LT(s["algorithm_speedup"][0]["low"].get<double>(), 1.7) << "the disturbance does not cancel";
  EXPECT_TRUE(has_caveat(s, "naive M=6 threads=1 and symmetric M=6 threads=1 were measured in different rounds"));
}

TEST_F(report, points_of_different_problems_are_not_compared) {
  const json s =
      summary_of({{"naive", 6, 1, 1.0}, {"symmetric", 6, 1, 0.5, 6, [](sample& p) { p.point.order = "shuffled"; }}});
  EXPECT_EQ(s["series"].size(), 2u);
  EXPECT_TRUE(s["algorithm_speedup"].empty());
  EXPECT_FALSE(has_caveat(s, "rounds"));
}

TEST_F(report, disturbed_rounds_are_a_caveat) {
  {
    row_writer writer(rows_path());
    writer.write(example::environment());
    for (int round = 1; round <= 6; ++round) {
      write_sample(writer, synthetic::step({"naive", 6, 1, 1.0}, round, 1));
      writer.write(synthetic::closing(round, 1, round == 3 ? 0.25 : 0.05));
    }
  }
  const json s = make();
  EXPECT_EQ(s["rounds"]["others_share"], 0.25);
  EXPECT_TRUE(has_caveat(s, "rows.jsonl: in 1 of 6 rounds other processes used more than 5 % of the machine"));
}

TEST_F(report, undisturbed_rounds_are_none) { EXPECT_FALSE(has_caveat(summary_of(talk()), "other processes")); }

TEST_F(report, wrong_input_is_refused_in_one_line) {
  const report_options options{file("out"), false};
  EXPECT_CONTAINS(message_of([&] { make_report({}, options); }), "at least one rows file");
  EXPECT_CONTAINS(message_of([&] { make_report({folder_}, options); }), "no rows files");
  EXPECT_CONTAINS(message_of([&] { make_report({file("none")}, options); }), "No such file");
  { row_writer(rows_path()).write(example::environment()); }
  EXPECT_CONTAINS(message_of([&] { make_report({rows_path()}, options); }), "no finished round");
  EXPECT_FALSE(std::filesystem::exists(file("out")));
  std::filesystem::remove(rows_path());
  write(talk());
  const report_options below{put("plain", "text") / "inside", false};
  EXPECT_CONTAINS(message_of([&] { make_report({rows_path()}, below); }),
                  "cannot write " + (below.folder / "summary.json").string());
}

TEST_F(report, a_file_given_twice_counts_once_and_no_temporary_file_stays) {
  write(talk());
  make_report({file("talk"), rows_path()}, {file("out"), false});
  EXPECT_EQ(json::parse(get(file("out/summary.json")))["sources"].size(), 1u);
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(file("out")))
    if (entry.is_regular_file()) files.insert(entry.path().filename());
  EXPECT_EQ(files, (std::set<std::string>{"summary.json", "tables.txt", "tables.md", "algorithm_speedup.csv",
                                          "environments.csv", "m_comparison.csv", "points.csv", "questions.csv",
                                          "runtime_comparison.csv", "series.csv", "speedup.csv"}));
}

TEST_F(report, a_table_that_is_empty_now_leaves_no_old_file) {
  summary_of(talk());
  std::filesystem::remove(rows_path());
  summary_of({{"naive", 6, 1, 1.0}});
  EXPECT_FALSE(std::filesystem::exists(file("out/csv/speedup.csv")));
  EXPECT_TRUE(std::filesystem::exists(file("out/csv/points.csv")));
}

}  // namespace
}  // namespace pairsum::harness

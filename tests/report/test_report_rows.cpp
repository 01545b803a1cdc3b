#include "tests/report/report_fixture.hpp"

// Which rows enter a report, and how it compares points.
namespace pairsum::harness {
namespace {

TEST_F(report, unverified_rows_are_listed_and_in_no_table) {
  write_all();
  {
    row_writer writer(rows_path());
    sample bad = synthetic::step("wrong_omp", 6, 2, 0.1, 1, 1);
    bad.error = "particle 7 is off";
    bad.phases.reset();
    writer.write(bad);
    sample unverified = synthetic::step("unsure_omp", 6, 2, 0.1, 1, 1);
    unverified.verify.fingerprint.reset();
    writer.write(unverified);
    // One bad step takes its whole repetition away, and only that.
    sample late = synthetic::step("naive", 6, 1, 0.001, 7, 1);
    writer.write(late);
    late.step = 2;
    late.verify.fingerprint.reset();
    writer.write(late);
  }
  const json s = make();
  EXPECT_EQ(s["points"].size(), 9u);
  ASSERT_EQ(s["failed"].size(), 3u);
  EXPECT_EQ(only(s["failed"], {{"backend", "wrong_omp"}})["error"], "particle 7 is off");
  EXPECT_EQ(only(s["failed"], {{"backend", "unsure_omp"}})["error"], "not verified");
  EXPECT_EQ(only(s["failed"], {{"backend", "naive"}})["rows"], 1);
  const json naive = only(s["points"], {{"backend", "naive"}, {"M", 6}});
  EXPECT_EQ(naive["repetitions"], 6);
  EXPECT_NEAR(naive["phases"]["sum_s"]["median"].get<double>(), 1.05, 1e-15);
  EXPECT_EQ(s["m_comparison"].size(), 9u);
  const std::size_t failed = text_.find("Failed points");
  ASSERT_NE(failed, std::string::npos);
  EXPECT_GT(text_.find("wrong_omp"), failed);
  EXPECT_GT(text_.find("unsure_omp"), failed);
}

TEST_F(report, void_rounds_do_not_count) {
  write_all();
  {
    row_writer writer(rows_path());
    sample slow = synthetic::step("naive", 6, 1, 1000.0, 1, 1);
    slow.round = 2;
    writer.write(slow);
    writer.write(example::voided());
  }
  const json s = make();
  EXPECT_EQ(only(s["points"], {{"backend", "naive"}, {"M", 6}})["repetitions"], 6);
}

TEST_F(report, points_without_a_common_repetition_are_compared_unpaired) {
  row_writer writer(rows_path());
  writer.write(example::environment());
  for (int repetition = 1; repetition <= 6; ++repetition) {
    sample s = synthetic::step("naive", 6, 1, 1.0, repetition, 1);
    writer.write(s);
    s = synthetic::step("symmetric", 6, 1, 0.5, repetition, 1);
    s.round = 2;
    writer.write(s);
  }
  const json s = make();
  ASSERT_EQ(s["algorithm_speedup"].size(), 1u);
  EXPECT_NEAR(s["algorithm_speedup"][0]["speedup"].get<double>(), 2, 1e-12);
  EXPECT_LT(s["algorithm_speedup"][0]["low"].get<double>(), 1.7) << "the disturbance does not cancel";
  EXPECT_TRUE(has_caveat(s, "naive M=6 threads=1 and symmetric M=6 threads=1 share no repetition"));
}

TEST_F(report, points_of_different_problems_are_not_compared) {
  row_writer writer(rows_path());
  writer.write(example::environment());
  write_point(writer, "naive", 6, 1, 1.0);
  for (int repetition = 1; repetition <= 6; ++repetition) {
    sample s = synthetic::step("symmetric", 6, 1, 0.5, repetition, 1);
    s.point.order = "shuffled";
    writer.write(s);
  }
  const json s = make();
  EXPECT_EQ(s["series"].size(), 2u);
  EXPECT_TRUE(s["algorithm_speedup"].empty());
  EXPECT_FALSE(has_caveat(s, "repetitions"));
}

TEST_F(report, different_machines_and_builds_are_refused_unless_allowed) {
  write_all();
  const std::vector<std::function<void(environment_row&)>> changes{
      [](environment_row& e) { e.host = "other"; },     [](environment_row& e) { e.cpu = "other"; },
      [](environment_row& e) { e.compiler = "other"; }, [](environment_row& e) { e.flags = "other"; },
      [](environment_row& e) { e.git = "other"; },      [](environment_row& e) { e.dirty = false; }};
  for (const auto& change : changes) {
    std::filesystem::remove(file("talk/second.jsonl"));
    environment_row e = example::environment();
    change(e);
    e.environment = "1111111111111111";
    sample s = synthetic::step("naive", 6, 1, 7.0, 1, 1);
    s.environment = e.environment;
    {
      row_writer writer(file("talk/second.jsonl"));
      writer.write(e);
      writer.write(s);
    }
    const std::string what = message_of([&] { make(); });
    EXPECT_CONTAINS(what, "the rows come from different machines or builds: ");
    EXPECT_CONTAINS(what, e.dirty ? "other" : "uncommitted changes");
    const json mixed = make(true);
    EXPECT_EQ(mixed["series"].size(), 2u);
    EXPECT_EQ(mixed["points"].size(), 10u);
    EXPECT_TRUE(has_caveat(mixed, "naive M=6 threads=1 (dam_break, rest, dx 0.00594, lattice, double, ferrari09,"));
    EXPECT_TRUE(has_caveat(mixed, "rows of different machines or builds in one report"));
  }
}

TEST_F(report, another_environment_of_the_same_build_is_the_same_series) {
  write_all();
  environment_row e = example::environment();
  e.environment = "1111111111111111";
  e.governor = "powersave";
  sample s = synthetic::step("naive", 6, 1, 1.0, 1, 1);
  s.environment = e.environment;
  {
    row_writer writer(file("talk/second.jsonl"));
    writer.write(e);
    writer.write(s);
  }
  const json summary = make();
  EXPECT_EQ(only(summary["points"], {{"backend", "naive"}, {"M", 6}})["repetitions"], 7);
  EXPECT_TRUE(has_caveat(summary, "different frequency governors"));
}

TEST_F(report, wrong_input_is_refused_in_one_line) {
  const report_options options{file("summary.json"), false};
  EXPECT_CONTAINS(message_of([&] { make_report({}, options); }), "at least one rows file");
  EXPECT_CONTAINS(message_of([&] { make_report({folder_}, options); }), "no rows files");
  EXPECT_CONTAINS(message_of([&] { make_report({file("none")}, options); }), "No such file");
  { row_writer(rows_path()).write(example::environment()); }
  EXPECT_CONTAINS(message_of([&] { make_report({rows_path()}, options); }), "no samples");
  write_all();
  const report_options below{put("plain", "text") / "summary.json", false};
  EXPECT_CONTAINS(message_of([&] { make_report({rows_path()}, below); }),
                  "cannot write the summary to " + below.summary_path.string());
}

TEST_F(report, a_file_given_twice_counts_once_and_no_temporary_file_stays) {
  write_all();
  const report_options options{file("out/summary.json"), false};
  make_report({file("talk"), rows_path()}, options);
  EXPECT_EQ(json::parse(get(options.summary_path))["sources"].size(), 1u);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(file("out"))) {
    ++files;
    EXPECT_EQ(entry.path().filename(), "summary.json");
  }
  EXPECT_EQ(files, 1u);
}

}  // namespace
}  // namespace pairsum::harness

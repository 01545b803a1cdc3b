#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "harness/report/report.hpp"
#include "harness/report/summary.hpp"
#include "tests/report/synthetic.hpp"
#include "tests/rows/scratch.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;
using synthetic::write_point;

class report : public scratch {
 protected:
  std::filesystem::path rows_path() const { return file("talk/rows.jsonl"); }

  /// The talk's comparisons with known times.
  void write_all() const {
    row_writer writer(rows_path());
    writer.write(example::environment());
    write_point(writer, "naive", 6, 1, 1.0);
    write_point(writer, "naive", 7, 1, 0.8);
    write_point(writer, "symmetric", 6, 1, 0.5);
    write_point(writer, "naive_omp", 6, 2, 0.6);
    write_point(writer, "symmetric_omp", 6, 1, 0.5);
    write_point(writer, "symmetric_omp", 6, 2, 0.3);
    write_point(writer, "symmetric_tbb", 6, 1, 0.5);
    write_point(writer, "symmetric_tbb", 6, 2, 0.2);
    write_point(writer, "symmetric_tbb", 6, 4, 0.2, 5);
  }

  json make(bool allow_mixed = false) {
    report_options options;
    options.summary_path = file("out/summary.json");
    options.allow_mixed = allow_mixed;
    text_ = make_report({file("talk")}, options);
    return json::parse(get(options.summary_path));
  }

  static json only(const json& entries, const json& wanted) {
    json found;
    for (const json& entry : entries) {
      const json& keys = entry.contains("point") ? entry["point"] : entry;
      bool same = true;
      for (const auto& item : wanted.items()) same = same && keys.at(item.key()) == item.value();
      if (!same) continue;
      EXPECT_TRUE(found.is_null()) << "two entries for " << wanted;
      found = entry;
    }
    return found;
  }

  static bool has_caveat(const json& summary, const std::string& part) {
    for (const json& caveat : summary["caveats"])
      if (caveat.get<std::string>().find(part) != std::string::npos) return true;
    return false;
  }

  std::string text_;
};

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
  EXPECT_TRUE(few["low"].is_null());
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

TEST_F(report, points_without_a_common_repetition_are_compared_by_medians) {
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
  EXPECT_TRUE(s["algorithm_speedup"][0]["low"].is_null());
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
    EXPECT_TRUE(has_caveat(mixed, "naive M=6 threads=1 (dam_break, rest, dx 0.00594, lattice, study"));
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

#include <pairsum/core/error.hpp>
#include <pairsum/sum/registry.hpp>
#include "tests/report/report_fixture.hpp"

// Peaks of the machine and the bound they set.
namespace pairsum::harness {
namespace {

peak_row peak(int threads, double bandwidth, double flops) {
  peak_row p = example::peak();
  p.threads = threads;
  p.bandwidth_bytes_per_s = bandwidth;
  p.flops_per_s = flops;
  return p;
}

/// The formula that only counts, which has 9 flops per distance test in 3D.
void counting(sample& s) {
  s.point.interaction = "count";
  s.point.dim = 3;
}

class report_of_machine : public report {
 protected:
  void write_with(const std::vector<peak_row>& peaks, const std::vector<made_point>& points) const {
    row_writer writer(rows_path());
    writer.write(example::environment());
    for (const peak_row& p : peaks) writer.write(p);
    synthetic::write_rounds(writer, points);
  }
  static bool has_formula() {
    const auto all = registry::instance().interactions();
    return std::ranges::find(all, "count") != all.end();
  }
};

TEST_F(report_of_machine, peaks_keep_the_best_of_each_kind) {
  write_with({peak(1, 1e10, 5e10), peak(1, 2e10, 4e10), peak(2, 3e10, 8e10)}, talk());
  const json s = make();
  EXPECT_EQ(s["peaks"], json({{{"environment", "0123456789abcdef"},
                               {"threads", 1},
                               {"precision", "double"},
                               {"bandwidth_bytes_per_s", 2e10},
                               {"flops_per_s", 5e10}},
                              {{"environment", "0123456789abcdef"},
                               {"threads", 2},
                               {"precision", "double"},
                               {"bandwidth_bytes_per_s", 3e10},
                               {"flops_per_s", 8e10}}}));
  const json e = only(s["speedup"], {{"backend", "symmetric_tbb"}, {"threads", 2}});
  EXPECT_VALUE(e["machine_flops_scaling"], 1.6);
  EXPECT_VALUE(e["machine_bandwidth_scaling"], 1.5);
  EXPECT_TRUE(only(s["speedup"], {{"threads", 4}})["machine_flops_scaling"].is_null());
}

/// The sum becomes 1.5 times as fast on 2 threads and the multiply-adds 1.875 times, in each of the rounds, however
/// these are disturbed: 0.8 of the machine.
TEST_F(report_of_machine, speedups_are_set_against_the_paces_of_their_rounds) {
  {
    row_writer writer(rows_path());
    writer.write(example::environment());
    synthetic::write_paces(writer, 4e10, 7.5e10);
    synthetic::write_rounds(writer, {{"tiles_omp", 6, 1, 0.6}, {"tiles_omp", 6, 2, 0.4}, {"tiles_omp", 6, 4, 0.2}});
  }
  const json s = make();
  const json two = only(s["speedup"], {{"threads", 2}});
  EXPECT_VALUE(two["machine_speedup"]["value"], 1.875);
  EXPECT_VALUE(two["of_machine"]["value"], 0.8);
  EXPECT_NEAR(two["of_machine"]["low"].get<double>(), 0.8, 1e-9);
  EXPECT_EQ(two["of_machine"]["rounds"], 6);
  const json four = only(s["speedup"], {{"threads", 4}});
  EXPECT_TRUE(four["of_machine"]["value"].is_null()) << "its pace was not measured";
  EXPECT_CONTAINS(text_, "how many times as many multiply-adds the machine made in the same rounds");
  EXPECT_CONTAINS(text_, "1.500  [1.500, 1.500]    1.875  [1.875, 1.875]       0.800  [0.800, 0.800]");
}

/// In two of six rounds the threads shared a core: the median is not moved.
TEST_F(report_of_machine, a_few_odd_paces_do_not_count) {
  {
    row_writer writer(rows_path());
    writer.write(example::environment());
    pace_row pace = example::pace();
    for (pace.round = 1; pace.round <= 6; ++pace.round)
      for (pace.threads = 1; pace.threads <= 2; ++pace.threads) {
        pace.flops_per_s = pace.threads == 2 && pace.round > 2 ? 8e10 : 4e10;
        writer.write(pace);
      }
    synthetic::write_rounds(writer, {{"tiles_omp", 6, 1, 0.6}, {"tiles_omp", 6, 2, 0.4}});
  }
  const json two = only(make()["speedup"], {{"threads", 2}});
  EXPECT_VALUE(two["machine_speedup"]["value"], 2.0);
  EXPECT_VALUE(two["machine_speedup"]["low"], 1.0);
  EXPECT_VALUE(two["of_machine"]["value"], 0.75);
  EXPECT_VALUE(two["of_machine"]["high"], 1.5);
}

/// A peak that the rounds surpassed was measured too low.
TEST_F(report_of_machine, paces_raise_the_peaks) {
  {
    row_writer writer(rows_path());
    writer.write(example::environment());
    writer.write(peak(1, 1e10, 5e10));
    writer.write(peak(2, 1e10, 1e11));
    pace_row pace = example::pace();
    pace.round = 1;
    pace.threads = 1;
    pace.flops_per_s = 6e10;
    writer.write(pace);
    pace.threads = 2;
    writer.write(pace);
    synthetic::write_rounds(writer, talk());
  }
  const json s = make();
  EXPECT_EQ(only(s["peaks"], {{"threads", 1}})["flops_per_s"], 6e10);
  EXPECT_EQ(only(s["peaks"], {{"threads", 2}})["flops_per_s"], 1e11);
}

TEST_F(report_of_machine, the_bound_is_set_against_the_measured_time) {
  if (!has_formula()) GTEST_SKIP() << "this build has not the formula";
  write_with({peak(1, 1e10, 1e9)}, {{"naive", 6, 1, 0.72 / 1.05, 6, counting}});
  const json m = make()["points"].at(0)["model"];
  ASSERT_TRUE(m.is_object());
  EXPECT_VALUE(m["flops"], 9.0 * 8e6);
  EXPECT_VALUE(m["bound_s"], 0.072);
  EXPECT_EQ(m["limited_by"], "flops");
  EXPECT_VALUE(m["share_of_bound"], 0.1);
  EXPECT_VALUE(m["achieved_flops_per_s"], 1e8);
  EXPECT_VALUE(m["intensity"], m["flops"].get<double>() / m["bytes"].get<double>());
  EXPECT_EQ(m["bandwidth_bytes_per_s"], 1e10);
  EXPECT_CONTAINS(text_, "10.0 %");
}

TEST_F(report_of_machine, little_bandwidth_limits_instead) {
  if (!has_formula()) GTEST_SKIP() << "this build has not the formula";
  write_with({peak(1, 1e6, 1e12)}, {{"naive", 6, 1, 1.0, 6, counting}});
  const json m = make()["points"].at(0)["model"];
  EXPECT_EQ(m["limited_by"], "bandwidth");
  EXPECT_VALUE(m["bound_s"], m["bytes"].get<double>() / 1e6);
}

TEST_F(report_of_machine, no_bound_without_peaks_work_or_formula) {
  const auto uncounted = [](sample& s) {
    counting(s);
    s.work.reset();
  };
  const auto unknown = [](sample& s) { s.point.interaction = "of_another_build"; };
  write_with({peak(1, 1e10, 1e9)}, {{"naive", 6, 2, 1.0, 6, counting},
                                    {"naive", 7, 1, 1.0, 6, uncounted},
                                    {"naive", 8, 1, 1.0, 6, unknown},
                                    {"of_another_build", 6, 1, 1.0, 6, counting}});
  const json s = make();
  for (const json& p : s["points"]) EXPECT_TRUE(p["model"].is_null()) << p["point"];
}

TEST_F(report_of_machine, peaks_count_for_every_environment_of_their_build) {
  if (!has_formula()) GTEST_SKIP() << "this build has not the formula";
  {
    row_writer writer(rows_path());
    environment_row later = example::environment();
    later.environment = "1111111111111111";
    later.governor = "powersave";
    writer.write(example::environment());
    writer.write(later);
    peak_row p = peak(1, 1e10, 1e9);
    p.environment = later.environment;
    writer.write(p);
    const made_point first{"naive", 6, 1, 1.0, 6, counting};
    made_point second = first;
    second.change = [&](sample& s) {
      counting(s);
      s.environment = later.environment;
    };
    synthetic::write_round(writer, 1, {first});
    synthetic::write_round(writer, 2, {second});
  }
  EXPECT_TRUE(make()["points"].at(0)["model"].is_object());
}

}  // namespace
}  // namespace pairsum::harness

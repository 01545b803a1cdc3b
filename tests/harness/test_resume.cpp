#include <fcntl.h>
#include <sys/file.h>

#include <fstream>
#include <set>

#include "core/error.hpp"
#include "harness/rows/writer.hpp"
#include "study_fixture.hpp"

// What becomes of a study that is cut, and of one that is carried out again.
namespace pairsum::harness {
namespace {

class resume_test : public study_test {
 protected:
  static study_plan three_rounds() {
    run_request r = small();
    r.backends = {"naive", "symmetric_omp"};
    r.M = {3};
    r.repetitions = 1;
    return plan_of(r, 3);
  }

  /// Carries orders out, but the process of measuring number `at` ends like `end` after its rows are there.
  static launcher ending(int at, departure end, int times = 1) {
    const auto count = std::make_shared<int>(0);
    return [=](const order& o) {
      departure d = in_this_process(registry::instance())(o);
      if (o.what == errand::measure && ++*count >= at && *count < at + times) return end;
      return d;
    };
  }

  std::filesystem::path path() const { return folder_ / "rows.jsonl"; }

  static std::set<int> replicates(const rows_file& rows) {
    std::set<int> found;
    for (const round_row& r : rows.finished_rounds()) EXPECT_TRUE(found.insert(r.replicate).second);
    return found;
  }
};

TEST_F(resume_test, a_round_whose_process_dies_is_voided_and_measured_again) {
  const study_plan plan = three_rounds();
  ASSERT_EQ(conduct(plan, {path(), "none", {ending(2, {0, 9, 0})}}, registry::instance()), 0);
  const rows_file rows = read_rows(path());
  EXPECT_EQ(replicates(rows), (std::set<int>{1, 2, 3}));
  ASSERT_EQ(rows.voids.size(), 1u);
  EXPECT_EQ(rows.voids[0].round, 2);
  EXPECT_NE(rows.voids[0].reason.find("signal 9"), std::string::npos);
  EXPECT_EQ(rows.ends.size(), 1u);
  EXPECT_TRUE(rows.unfinished_rounds().empty());
}

TEST_F(resume_test, a_round_that_never_ends_well_is_given_up) {
  EXPECT_EQ(conduct(three_rounds(), {path(), "none", {ending(2, {0, 11, 0}, 100)}}, registry::instance()), 2);
  const rows_file rows = read_rows(path());
  EXPECT_EQ(replicates(rows), std::set<int>{1});
  EXPECT_EQ(rows.voids.size(), 3u);
  EXPECT_TRUE(rows.ends.empty());
}

TEST_F(resume_test, an_interrupted_study_goes_on_where_it_was) {
  const study_plan plan = three_rounds();
  EXPECT_EQ(conduct(plan, {path(), "none", {ending(2, {130, 0, 0})}}, registry::instance()), 130);
  EXPECT_TRUE(read_rows(path()).ends.empty());
  EXPECT_EQ(rows_path(folder_.parent_path(), plan, false).empty(), false);
  EXPECT_EQ(conduct(plan, {path(), "none", {ending(100, {})}}, registry::instance()), 0);
  const rows_file rows = read_rows(path());
  EXPECT_EQ(replicates(rows), (std::set<int>{1, 2, 3}));
  EXPECT_EQ(rows.voids.size(), 1u);
  EXPECT_EQ(rows.ends.size(), 1u);
}

TEST_F(resume_test, a_killed_conductor_leaves_a_round_that_is_voided_later) {
  const study_plan plan = three_rounds();
  ASSERT_EQ(run(plan_of(plan.parts[0].request, 1), path()), 0);  // rows of a plan that is another one
  row_writer(path()).write([&] {
    sample s = read_rows(path()).samples.front();
    s.round = 2;
    return s;
  }());
  std::ofstream(path(), std::ios::app) << "{\"kind\":\"sam";
  ASSERT_EQ(run(plan, path()), 0);
  const rows_file rows = read_rows(path());
  ASSERT_EQ(rows.voids.size(), 1u);
  EXPECT_EQ(rows.voids[0].round, 2);
  EXPECT_TRUE(rows.unfinished_rounds().empty());
  EXPECT_EQ(rows.finished_rounds().size(), 4u);
}

TEST_F(resume_test, an_ended_plan_is_carried_out_again) {
  const study_plan plan = three_rounds();
  ASSERT_EQ(run(plan, path()), 0);
  ASSERT_EQ(run(plan, path()), 0);
  const rows_file rows = read_rows(path());
  EXPECT_EQ(replicates(rows), (std::set<int>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(rows.ends.size(), 2u);
}

TEST_F(resume_test, rows_of_another_build_are_left_alone) {
  const study_plan plan = three_rounds();
  ASSERT_EQ(run(plan_of(plan.parts[0].request, 1), path()), 0);
  environment_row e = read_rows(path()).environments.front();
  e.git = "0123456789ab";
  e.environment = "00000000000000ff";
  row_writer(path()).write(e);
  const std::string what = refusal_of([&] { run(plan, path()); });
  EXPECT_NE(what.find("another machine or build"), std::string::npos) << what;
}

TEST_F(resume_test, a_file_that_is_being_written_is_left_alone) {
  ASSERT_EQ(run(three_rounds(), path()), 0);
  const int file = ::open(path().c_str(), O_RDONLY);
  ASSERT_EQ(::flock(file, LOCK_EX), 0);
  const auto size = std::filesystem::file_size(path());
  EXPECT_NE(refusal_of([&] { run(three_rounds(), path()); }).find("is being written"), std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(path()), size);
  ::close(file);
}

TEST_F(resume_test, builds_are_measured_in_the_same_rounds) {
  study_plan plan = three_rounds();
  plan.builds = 2;
  const launcher one = in_this_process(registry::instance());
  ASSERT_EQ(conduct(plan, {path(), "none", {one, one}}, registry::instance()), 0);
  const rows_file rows = read_rows(path());
  EXPECT_EQ(rows.finished_rounds().size(), 3u);
  EXPECT_EQ(rows.samples.size(), 3u * 2 * (1 + 2) * 3);
}

TEST_F(resume_test, narrow_intervals_end_a_part) {
  study_plan plan = three_rounds();
  plan.parts[0].least_rounds = 6;
  plan.parts[0].most_rounds = 1000;
  plan.parts[0].half_width = 1000;
  ASSERT_EQ(run(plan, path()), 0);
  EXPECT_EQ(read_rows(path()).finished_rounds().size(), 6u);
}

TEST_F(resume_test, a_file_that_cannot_be_written_is_told_at_once_and_nothing_is_left) {
  int launched = 0;
  const launcher count = [&](const order&) {
    ++launched;
    return departure{2, 0, 0};
  };
  EXPECT_NE(refusal_of([&] {
              conduct(three_rounds(), {"/proc/none/rows.jsonl", "none", {count}}, registry::instance());
            }).find("cannot write rows"),
            std::string::npos);
  EXPECT_EQ(launched, 0);
  EXPECT_EQ(conduct(three_rounds(), {path(), "none", {count}}, registry::instance()), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

}  // namespace
}  // namespace pairsum::harness

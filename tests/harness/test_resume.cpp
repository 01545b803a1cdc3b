#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "cut_studies.hpp"

namespace pairsum::harness {
namespace {

using resume = cut_study;

TEST_F(resume, a_round_that_was_cut_is_voided_and_measured_again) {
  kill_in_round(2);
  kill_in_round(4);  // the third is the second again
  ASSERT_EQ(conduct_again(), 0);
  EXPECT_EQ(voided(), (std::vector<int>{2, 4}));
  expect_whole();
}

TEST_F(resume, finished_rounds_are_not_measured_again) {
  kill_in_round(3);
  const auto before = read_rows(path_).finished_rounds();
  std::vector<std::string> measured;
  ASSERT_EQ(conduct_with(watched([&](const order& o, int) {
              if (o.what == errand::measure) measured.push_back(o.plan.parts[o.part].request.part);
              return departure{};
            })),
            0);
  EXPECT_EQ(measured, (std::vector<std::string>{"b", "b"}));
  const auto after = read_rows(path_).finished_rounds();
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
  expect_whole();
}

TEST_F(resume, a_plan_that_ended_is_carried_out_anew_with_the_next_replicates) {
  ASSERT_EQ(conduct_again(), 0);
  ASSERT_EQ(conduct_again(), 0);
  const rows_file rows = read_rows(path_);
  EXPECT_EQ(rows.ends.size(), 2u);
  std::set<std::pair<std::string, int>> replicates;
  for (const round_row& r : rows.rounds) replicates.emplace(r.part, r.replicate);
  EXPECT_EQ(replicates.size(), 8u);
  EXPECT_TRUE(replicates.count({"b", 4}) == 1);
}

TEST_F(resume, another_plan_in_the_same_file_has_rounds_of_its_own) {
  ASSERT_EQ(conduct_again(), 0);
  plan_.parts[0].request.steps = 3;
  ASSERT_EQ(conduct_again(), 0);
  EXPECT_EQ(read_rows(path_).rounds.size(), 8u);
}

TEST_F(resume, with_another_budget_it_is_the_same_plan) {
  kill_in_round(2);
  plan_.budget_s = 1000;
  ASSERT_EQ(conduct_again(), 0);
  expect_whole();
}

TEST_F(resume, rows_of_another_build_or_machine_are_refused) {
  kill_in_round(2);
  const std::string text = text_of(path_);
  for (const char* key : {"git", "host", "compiler", "flags", "cpu"}) {
    std::string other = text;
    const std::string begin = "\"" + std::string(key) + "\":\"";
    other.replace(other.find(begin), begin.size(), begin + "other");
    write_text(path_, other);
    expect_refused("another machine or build");
    plan_.builds = 2;
    if (std::string(key) == "host") expect_refused("another machine or build");
    plan_.builds = 1;
  }
}

TEST_F(resume, a_file_that_another_process_writes_is_refused) {
  kill_in_round(2);
  const int file = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(file, LOCK_EX | LOCK_NB), 0);
  expect_refused("is being written by another");
  close(file);
  ASSERT_EQ(conduct_again(), 0);
  expect_whole();
}

TEST_F(resume, the_file_is_locked_while_a_study_writes_it) {
  bool locked = true;
  ASSERT_EQ(conduct_with(watched([&](const order&, int) {
              const int file = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
              if (file >= 0) locked = locked && flock(file, LOCK_EX | LOCK_NB) != 0;
              close(file);
              return departure{};
            })),
            0);
  EXPECT_TRUE(locked);
}

TEST_F(resume, a_last_line_that_was_cut_is_mended) {
  kill_in_round(2);
  const std::string whole = text_of(path_);
  for (const std::size_t cut : {1u, 20u, 300u}) {
    write_text(path_, whole.substr(0, whole.size() - cut));
    ASSERT_EQ(conduct_again(), 0);
    EXPECT_EQ(voided(), (std::vector<int>{2}));
    expect_whole();
  }
}

TEST_F(resume, a_cut_file_is_found_under_the_results) {
  if (describe_environment("test").dirty) GTEST_SKIP() << "builds with uncommitted changes cannot be told apart";
  path_ = folder_ / "test" / "a.jsonl";
  kill_in_round(2);
  write_text(path_, text_of(path_) + "{\"kind\":");
  // Two builds with uncommitted changes cannot be told apart, so nothing is resumed with one.
  EXPECT_EQ(rows_path(folder_, plan_, false, "none") == path_, !describe_environment("test").dirty);
  EXPECT_NE(rows_path(folder_, plan_, false, "cores_first"), path_) << "measured with another binding";
  EXPECT_NE(rows_path(folder_, plan_, true, "none"), path_) << "a fresh one is wanted";
  EXPECT_NE(rows_path(folder_, plan_, true, "none"), rows_path(folder_, plan_, true, "none")) << "begun at once";
  EXPECT_NE(rows_path(folder_, study_of({small_part("other", 1)}), false, "none"), path_);
  ASSERT_EQ(conduct_again(), 0);
  EXPECT_NE(rows_path(folder_, plan_, false, "none"), path_) << "it came to its end";
}

TEST_F(resume, of_a_new_file_two_studies_cannot_write) {
  std::string said;
  ASSERT_EQ(conduct_with(watched([&](const order& o, int) {
              if (o.what == errand::measure && o.round == 1) said = refusal_of([&] { conduct_again(); });
              return departure{};
            })),
            0);
  EXPECT_NE(said.find("is being written by another"), std::string::npos) << said;
  expect_whole();
}

}  // namespace
}  // namespace pairsum::harness

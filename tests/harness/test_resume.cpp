#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <set>

#include "core/error.hpp"
#include "harness/environment/environment.hpp"
#include "harness/rows/writer.hpp"
#include "lying_backends.hpp"
#include "study_fixture.hpp"

namespace pairsum::harness {
namespace {

struct killed {};

/// In this process, but calls `before_end(order, how often it was called)` when the rows of an order are written.
launcher watched(std::function<departure(const order&, int)> before_end, const registry& all = registry::instance()) {
  return [&all, before_end = std::move(before_end), n = 0](const order& o) mutable {
    const departure end = in_this_process(all)(o);
    const departure instead = before_end(o, ++n);
    return instead.code != 0 || instead.signal != 0 ? instead : end;
  };
}

/// Ends so at the rounds with these numbers.
launcher ending(std::set<int> rounds, departure how) {
  return watched(
      [=](const order& o, int) { return o.what == errand::measure && rounds.count(o.round) != 0 ? how : departure{}; });
}

class resume : public study_test {
 protected:
  static constexpr departure signal_9{0, SIGKILL, 0}, interrupt{130, 0, 0};

  int conduct_with(launcher l) { return conduct_here(plan_, path_, registry::instance(), {std::move(l)}); }
  int conduct_again() { return conduct_here(plan_, path_); }

  /// The study's process is killed when the rows of that round are written.
  void kill_in_round(int round) {
    EXPECT_THROW(conduct_with(watched([=](const order& o, int) -> departure {
                   if (o.what == errand::measure && o.round == round) throw killed{};
                   return {};
                 })),
                 killed);
  }

  /// Every replicate of every part is there once, and nothing else counts.
  void expect_whole() const {
    const rows_file rows = read_rows(path_);
    std::multiset<std::pair<std::string, int>> found, wanted;
    for (const round_row& r : rows.finished_rounds()) found.emplace(r.part, r.replicate);
    for (const part_plan& p : plan_.parts)
      for (int k = 1; k <= p.most_rounds; ++k) wanted.emplace(p.request.part, k);
    EXPECT_EQ(found, wanted);
    EXPECT_TRUE(rows.unfinished_rounds().empty());
    EXPECT_EQ(rows.ends.size(), 1u);
    EXPECT_EQ(rows.valid_samples().size(), found.size() * 2);
  }

  std::vector<int> voided() const {
    std::vector<int> rounds;
    for (const void_row& v : read_rows(path_).voids) rounds.push_back(v.round);
    return rounds;
  }

  void expect_refused(const std::string& says) {
    const std::string before = text_of(path_);
    try {
      conduct_again();
      ADD_FAILURE() << "accepted, should say: " << says;
    } catch (const error& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
    EXPECT_EQ(text_of(path_), before);
  }

  study_plan plan_ = study_of({small_part("a", 2), small_part("b", 2)});
};

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
  EXPECT_NE(rows_path(folder_, study_of({small_part("other", 1)}), false, "none"), path_);
  ASSERT_EQ(conduct_again(), 0);
  EXPECT_NE(rows_path(folder_, plan_, false, "none"), path_) << "it came to its end";
}

TEST_F(resume, a_process_that_was_killed_has_its_round_repeated) {
  ASSERT_EQ(conduct_with(ending({1, 2, 4}, signal_9)), 0);
  EXPECT_EQ(voided(), (std::vector<int>{1, 2, 4}));
  expect_whole();
}

TEST_F(resume, a_round_whose_process_dies_each_time_is_given_up) {
  EXPECT_EQ(conduct_with(ending({2, 3, 4, 5}, signal_9)), 2);
  EXPECT_EQ(voided(), (std::vector<int>{2, 3, 4}));
  EXPECT_TRUE(read_rows(path_).ends.empty());
  ASSERT_EQ(conduct_again(), 0);
  expect_whole();
}

TEST_F(resume, a_verification_that_was_killed_is_repeated_and_given_up) {
  int killed_times = 0;
  const auto at_verify = [&](int times) {
    return watched([&, times](const order& o, int) {
      return o.what == errand::verify && killed_times < times ? (++killed_times, signal_9) : departure{};
    });
  };
  ASSERT_EQ(conduct_with(at_verify(2)), 0);
  expect_whole();
  std::filesystem::remove(path_);
  killed_times = 0;
  EXPECT_EQ(conduct_with(at_verify(100)), 2);
  EXPECT_EQ(killed_times, 3);
  EXPECT_FALSE(std::filesystem::exists(path_)) << "nothing was measured";
}

TEST_F(resume, an_interrupt_voids_the_round_and_ends_without_an_end_row) {
  EXPECT_EQ(conduct_with(ending({2}, interrupt)), 130);
  EXPECT_EQ(voided(), (std::vector<int>{2}));
  EXPECT_TRUE(read_rows(path_).ends.empty());
  ASSERT_EQ(conduct_again(), 0);
  expect_whole();
}

TEST_F(resume, a_file_that_cannot_be_written_is_told_at_once_and_nothing_is_left) {
  int launched = 0;
  const launcher count = [&](const order&) {
    ++launched;
    return departure{2, 0, 0};
  };
  const std::string said =
      refusal_of([&] { conduct_here(plan_, "/proc/none/rows.jsonl", registry::instance(), {count}); });
  EXPECT_NE(said.find("cannot write rows"), std::string::npos) << said;
  EXPECT_EQ(launched, 0);
  EXPECT_EQ(conduct_with(count), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_));
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

TEST_F(resume, bad_input_that_a_process_finds_ends_the_study) {
  EXPECT_EQ(conduct_with(ending({2}, {2, 0, 0})), 2);
  EXPECT_EQ(voided(), (std::vector<int>{2}));
  EXPECT_TRUE(read_rows(path_).ends.empty());
}

TEST_F(resume, a_point_that_failed_before_is_not_forgotten) {
  const registry broken = broken_registry();
  plan_ = study_of({small_part("a", 2)});
  plan_.parts[0].request.backends = {"broken_none", "broken_drop_pair"};
  EXPECT_THROW(conduct_here(plan_, path_, broken,
                            {watched(
                                [](const order& o, int) -> departure {
                                  if (o.what == errand::measure && o.round == 2) throw killed{};
                                  return {};
                                },
                                broken)}),
               killed);
  plan_.parts[0].most_rounds = 2;
  EXPECT_EQ(conduct_here(plan_, path_, broken), 1);
  EXPECT_EQ(conduct_here(plan_, path_, broken), 1);
}

}  // namespace
}  // namespace pairsum::harness

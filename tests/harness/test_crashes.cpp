#include "cut_studies.hpp"
#include "lying_backends.hpp"

namespace pairsum::harness {
namespace {

using crashes = cut_study;

TEST_F(crashes, a_process_that_was_killed_has_its_round_repeated) {
  ASSERT_EQ(conduct_with(ending({1, 2, 4}, signal_9)), 0);
  EXPECT_EQ(voided(), (std::vector<int>{1, 2, 4}));
  expect_whole();
}

TEST_F(crashes, a_round_whose_process_dies_each_time_is_given_up) {
  EXPECT_EQ(conduct_with(ending({2, 3, 4, 5}, signal_9)), 2);
  EXPECT_EQ(voided(), (std::vector<int>{2, 3, 4}));
  EXPECT_TRUE(read_rows(path_).ends.empty());
  ASSERT_EQ(conduct_again(), 0);
  expect_whole();
}

TEST_F(crashes, a_verification_that_was_killed_is_repeated_and_given_up) {
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

TEST_F(crashes, an_exit_code_is_no_sign_that_the_work_was_done) {
  EXPECT_EQ(conduct_with(ending({2}, {1, 0, 0})), 2) << "as a library ends a process that it gives up";
  EXPECT_EQ(voided(), (std::vector<int>{2}));
  EXPECT_TRUE(read_rows(path_).ends.empty());
  ASSERT_EQ(conduct_again(), 0);
  expect_whole();
  const launcher silent = [sound = in_this_process(registry::instance())](const order& o) {
    departure end = sound(o);
    end.done = false;
    return end;
  };
  EXPECT_EQ(conduct_with(silent), 2) << "not even code 0";
}

TEST_F(crashes, a_file_that_is_no_longer_in_its_place_ends_the_study) {
  const std::filesystem::path away = folder_ / "away";
  const std::string gone = "was deleted, moved or replaced", cut = "was cut";
  const std::vector<std::pair<std::function<void()>, std::string>> faults{
      {[&] { std::filesystem::remove(path_); }, gone},
      {[&] { std::filesystem::rename(path_, away); }, gone},
      {[&] {
         write_text(away, text_of(path_));
         std::filesystem::rename(away, path_);
       },
       gone},
      {[&] { std::filesystem::resize_file(path_, 100); }, cut}};
  for (const auto& [fault, says] : faults) {
    std::filesystem::remove_all(folder_);
    int rounds = 0;
    const auto l = watched([&](const order& o, int) {
      if (o.what == errand::measure && ++rounds == 2) fault();
      return departure{};
    });
    const std::string said = refusal_of([&] { conduct_with(l); });
    EXPECT_NE(said.find("rows.jsonl " + says), std::string::npos) << said;
    EXPECT_EQ(rounds, 2) << "no round is measured whose rows nobody finds";
  }
}

TEST_F(crashes, an_interrupt_voids_the_round_and_ends_without_an_end_row) {
  EXPECT_EQ(conduct_with(ending({2}, interrupt)), 130);
  EXPECT_EQ(voided(), (std::vector<int>{2}));
  EXPECT_TRUE(read_rows(path_).ends.empty());
  ASSERT_EQ(conduct_again(), 0);
  expect_whole();
}

TEST_F(crashes, a_file_that_cannot_be_written_is_told_at_once_and_nothing_is_left) {
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

TEST_F(crashes, bad_input_that_a_process_finds_ends_the_study) {
  EXPECT_EQ(conduct_with(ending({2}, {2, 0, 0})), 2);
  EXPECT_EQ(voided(), (std::vector<int>{2}));
  EXPECT_TRUE(read_rows(path_).ends.empty());
}

TEST_F(crashes, a_point_that_failed_before_is_not_forgotten) {
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

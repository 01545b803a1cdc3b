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

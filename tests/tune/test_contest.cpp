#include <gtest/gtest.h>

#include "made_contest.hpp"

namespace pairsum::harness {
namespace {

TEST(contest, finds_the_fastest_among_many) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    made_contest c{.truth_s = {0.3, 0.12, 0.2, 0.1, 0.15, 0.9, 0.11}, .families = {"a", "b", "c", "d", "e", "d", "f"}};
    c.seed = seed;
    c.run();
    ASSERT_TRUE(winner_of(c.all).has_value());
    EXPECT_EQ(*winner_of(c.all), 3u) << "seed " << seed;
    EXPECT_LE(c.clock_s, c.budget_s + 1) << "it keeps to its time";
    EXPECT_GE(c.all[3].times.size(), 6u);
    EXPECT_EQ(c.all[5].what, fate::slow);
    EXPECT_TRUE(c.all[5].times.empty());
    EXPECT_EQ(std::ranges::count(c.measured, 5u), 1) << "a second look would be a waste";
  }
}

TEST(contest, a_drift_that_all_share_does_not_mislead_it) {
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    made_contest c{.truth_s = {0.105, 0.1, 0.12}, .budget_s = 100, .noise = 0.005, .drift = 0.05};
    c.seed = seed;
    c.rules.most_rounds = 400;
    c.run();
    right += *winner_of(c.all) == 1;
  }
  EXPECT_GE(right, 18);
}

TEST(contest, equals_stay_together_and_worse_ones_are_dropped) {
  made_contest c{.truth_s = {0.1, 0.1, 0.13}};
  c.run();
  EXPECT_EQ(c.all[0].what, fate::standing);
  EXPECT_EQ(c.all[1].what, fate::standing);
  EXPECT_EQ(c.all[2].what, fate::worse);
  EXPECT_LT(c.all[2].times.size(), c.all[0].times.size());
  EXPECT_EQ(c.all[0].times.size(), c.all[1].times.size());
}

/// A machine on which everything takes twice as long most of the time.
TEST(contest, one_lucky_look_does_not_decide) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    made_contest c{.truth_s = {0.12, 0.15, 0.1, 0.2, 0.14, 0.18, 0.25, 0.3}, .budget_s = 120};
    c.seed = seed;
    c.twice_as_long = 0.7;
    c.rules.most_rounds = 200;
    c.run();
    EXPECT_EQ(*winner_of(c.all), 2u) << "seed " << seed;
  }
}

TEST(contest, one_that_remains_is_measured_until_it_has_its_interval) {
  made_contest c{.truth_s = {0.1, 0.5}};
  c.run();
  EXPECT_EQ(c.all[1].what, fate::worse) << "there was the time to make sure";
  EXPECT_EQ(c.all[1].times.size(), 3u);
  EXPECT_EQ(c.all[0].times.size(), 6u);
  EXPECT_LT(c.clock_s, 10);
}

TEST(contest, the_rest_of_a_slow_family_is_passed_by) {
  made_contest c{.truth_s = {0.1, 0.5, 0.12, 0.5, 0.11, 0.05}, .families = {"a", "b", "a", "b", "a", "b"}};
  c.rules.fewest = 1;
  c.run();
  EXPECT_EQ(c.all[1].what, fate::slow);
  EXPECT_EQ(c.all[3].what, fate::passed_by);
  EXPECT_EQ(c.all[5].what, fate::passed_by) << "it would have won: what is not seen cannot be known";
  EXPECT_EQ(*winner_of(c.all), 0u);
}

TEST(contest, a_short_time_is_spent_on_the_faster_half) {
  made_contest c{.truth_s = {1.0, 1.1, 1.2, 1.3, 1.05, 1.25}, .budget_s = 40};
  c.run();
  EXPECT_EQ(*winner_of(c.all), 0u);
  EXPECT_LE(c.clock_s, 43);
  EXPECT_EQ(std::ranges::count(c.all, fate::not_seen, &contestant::what), 0);
  EXPECT_GT(std::ranges::count(c.all, fate::halved, &contestant::what), 0);
  EXPECT_GE(c.all[0].times.size(), 3u);
}

TEST(contest, what_the_time_has_no_room_for_is_not_seen) {
  made_contest c{.truth_s = std::vector<double>(50, 1.0), .budget_s = 20};
  c.run();
  EXPECT_EQ(c.looks(), 6u) << "60 % of 20 s, 2.1 s each";
  EXPECT_EQ(std::ranges::count(c.all, fate::not_seen, &contestant::what), 44);
  ASSERT_TRUE(winner_of(c.all).has_value());
  EXPECT_LE(c.clock_s, 22.5);
}

TEST(contest, one_look_is_all_that_a_tiny_time_gives) {
  made_contest c{.truth_s = {1.0, 1.1}, .budget_s = 2};
  c.run();
  EXPECT_EQ(c.looks(), 1u);
  EXPECT_EQ(*winner_of(c.all), 0u);
  EXPECT_TRUE(c.all[0].times.empty());
}

TEST(contest, a_wrong_candidate_cannot_win) {
  made_contest c{.truth_s = {0.05, 0.1, 0.1}, .wrong = {0}};
  c.run();
  EXPECT_EQ(c.all[0].what, fate::wrong);
  EXPECT_EQ(c.all[0].error, "made to be wrong");
  EXPECT_EQ(std::ranges::count(c.measured, 0u), 1) << "once is enough";
  EXPECT_NE(*winner_of(c.all), 0u);
  made_contest none{.truth_s = {0.1, 0.1}, .wrong = {0, 1}};
  none.run();
  EXPECT_FALSE(winner_of(none.all).has_value());
}

TEST(contest, an_interrupt_ends_it_and_the_round_under_way_does_not_count) {
  made_contest c{.truth_s = {0.1, 0.1, 0.1}, .interrupted_after = 3 + 3 + 2, .rules = {.looks = 1}};
  c.run();
  EXPECT_EQ(c.measured.size(), 8u);
  for (const contestant& one : c.all) EXPECT_EQ(one.times.size(), 1u);
  made_contest early{.truth_s = {0.1, 0.1, 0.1}, .interrupted_after = 0};
  early.run();
  EXPECT_FALSE(winner_of(early.all).has_value());
}

TEST(contest, a_round_measures_all_that_remain_once) {
  made_contest c{.truth_s = {0.1, 0.1, 0.1}, .noise = 0.2, .rules = {.looks = 1, .most_rounds = 2}};
  c.run();
  ASSERT_EQ(c.measured.size(), 3u + 6u);
  for (std::size_t begin = 3; begin < 9; begin += 3) {
    std::vector<std::size_t> round(c.measured.begin() + static_cast<std::ptrdiff_t>(begin),
                                   c.measured.begin() + static_cast<std::ptrdiff_t>(begin) + 3);
    std::ranges::sort(round);
    EXPECT_EQ(round, (std::vector<std::size_t>{0, 1, 2}));
  }
}

}  // namespace
}  // namespace pairsum::harness

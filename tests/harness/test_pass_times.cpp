#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "harness/measure/pass_times.hpp"

namespace pairsum::harness {
namespace {

void doze() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

void work(pass_times& times, unsigned pass, int thread) {
  times.work_begins(pass, thread);
  doze();
  times.work_ends(pass, thread);
}

TEST(pass_times, work_and_waiting_fill_each_pass) {
  pass_times times(2);
  EXPECT_FALSE(times.any());
  for (unsigned pass = 0; pass < 3; ++pass) {
    times.pass_begins(pass);
    work(times, pass, 0);
    if (pass == 1) {
      doze();
    } else {
      work(times, pass, 1);
    }
    times.pass_ends(pass);
  }
  EXPECT_TRUE(times.any());
  const auto busy = times.busy(), waiting = times.waiting();
  ASSERT_EQ(busy.size(), 3u);
  ASSERT_EQ(waiting.size(), 3u);
  for (std::size_t pass = 0; pass < 3; ++pass) {
    ASSERT_EQ(busy[pass].size(), 2u);
    // One after the other: what both threads worked and waited is the same length, and each waited for the other.
    EXPECT_NEAR(busy[pass][0] + waiting[pass][0], busy[pass][1] + waiting[pass][1], 1e-12);
    EXPECT_GE(busy[pass][0], 0.002);
    EXPECT_GE(waiting[pass][0], 0.002);
  }
  EXPECT_EQ(busy[1][1], 0) << "no chunk was left for it";
  EXPECT_GE(waiting[1][1], 0.004);
}

TEST(pass_times, chunks_of_a_thread_add_up) {
  pass_times times(1);
  times.pass_begins(0);
  for (int chunk = 0; chunk < 3; ++chunk) work(times, 0, 0);
  times.pass_ends(0);
  EXPECT_GE(times.busy()[0][0], 0.006);
}

TEST(pass_times, waiting_is_never_negative) {
  pass_times times(1);
  times.pass_begins(0);
  work(times, 0, 0);
  times.pass_begins(0);  // forgets that work
  times.work_begins(0, 0);
  times.pass_ends(0);  // the clock of the pass stops first
  doze();
  times.work_ends(0, 0);
  ASSERT_EQ(times.waiting().size(), 1u);
  EXPECT_GT(times.busy()[0][0], 0);
  EXPECT_EQ(times.waiting()[0][0], 0);
}

TEST(pass_times, a_new_sum_forgets_the_one_before) {
  pass_times times(1);
  for (int sum = 0; sum < 2; ++sum)
    for (unsigned pass = 0; pass < 2; ++pass) {
      times.pass_begins(pass);
      if (sum == 0) work(times, pass, 0);
      times.pass_ends(pass);
    }
  EXPECT_EQ(times.busy(), (pass_times::table{{0.0}, {0.0}}));
}

TEST(pass_times, threads_out_of_range_are_counted_with_the_nearest) {
  pass_times times(2);
  times.pass_begins(0);
  work(times, 0, -1);
  work(times, 0, 7);
  times.pass_ends(0);
  EXPECT_GT(times.busy()[0][0], 0);
  EXPECT_GT(times.busy()[0][1], 0);
}

}  // namespace
}  // namespace pairsum::harness

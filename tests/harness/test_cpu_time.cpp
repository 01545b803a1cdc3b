#include <gtest/gtest.h>

#include "harness/measure/cpu_time.hpp"

namespace pairsum::harness {
namespace {

TEST(cpu_time, the_share_of_others_is_what_was_busy_beside_the_own) {
  const machine_time before{100, 1000}, after{130, 1040};  // 30 s busy of 40 s
  EXPECT_DOUBLE_EQ(share_of_others(before, after, 10).value(), 0.5);
  EXPECT_DOUBLE_EQ(share_of_others(before, after, 0).value(), 0.75);
  EXPECT_DOUBLE_EQ(share_of_others(before, after, 30).value(), 0);
}

TEST(cpu_time, the_share_stays_within_its_range_though_the_kernel_counts_in_ticks) {
  const machine_time before{100, 1000}, after{130, 1040};
  EXPECT_EQ(share_of_others(before, after, 30.5), 0.0);
  EXPECT_EQ(share_of_others(before, machine_time{145, 1040}, 0), 1.0);
}

TEST(cpu_time, no_reading_or_no_time_between_them_gives_no_share) {
  const machine_time now{100, 1000};
  EXPECT_FALSE(share_of_others(now, now, 0));
  EXPECT_FALSE(share_of_others(std::nullopt, now, 0));
  EXPECT_FALSE(share_of_others(now, std::nullopt, 0));
  EXPECT_FALSE(share_of_others(now, machine_time{90, 990}, 0)) << "time does not run backwards";
}

TEST(cpu_time, the_own_time_grows_with_work) {
  const double before = own_time();
  volatile double x = 1;
  for (int k = 0; own_time() == before && k < 100; ++k)
    for (int i = 0; i < 1000000; ++i) x = x * 1.0000001;
  EXPECT_GT(own_time(), before);
}

TEST(cpu_time, the_machine_was_busy_for_a_part_of_its_time) {
  const auto now = machine_time_now();
  if (!now) GTEST_SKIP() << "/proc/stat does not tell";
  EXPECT_GT(now->busy_s, 0);
  EXPECT_GE(now->total_s, now->busy_s);
}

}  // namespace
}  // namespace pairsum::harness

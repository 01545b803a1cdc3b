#include <gtest/gtest.h>
#include <linux/perf_event.h>

#include <chrono>
#include <ctime>
#include <thread>

#include "harness/measure/counters.hpp"

namespace pairsum::harness {
namespace {

void be_busy(std::chrono::milliseconds span) {
  const auto end = std::chrono::steady_clock::now() + span;
  for (volatile unsigned n = 0; std::chrono::steady_clock::now() < end;) n = n + 1;
}

using std::chrono::milliseconds;
const counter_event task_clock{"task_clock", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK};
const counter_event impossible{"impossible", 0xfffffff0u, 1};

TEST(counters, count_or_say_why_not) {
  counters c;
  c.start();
  be_busy(milliseconds(20));
  const auto n = c.stop();
  if (c.why().empty()) {
    EXPECT_TRUE(n.cycles.value_or(0) > 0 || n.instructions.value_or(0) > 0);
    EXPECT_TRUE(c.description().find("none") == std::string::npos);
  } else {
    EXPECT_TRUE(c.why().starts_with("none: perf_event_open: ")) << c.why();
    EXPECT_EQ(c.description(), c.why());
    EXPECT_FALSE(n.cycles || n.instructions || n.cache_misses);
  }
}

TEST(counters, give_a_reason_for_an_impossible_event) {
  counters c(std::vector{impossible});
  EXPECT_TRUE(c.why().starts_with("none: perf_event_open: ")) << c.why();
  c.start();
  EXPECT_FALSE(c.stop().cycles);
  EXPECT_EQ(counters(std::vector<counter_event>{}).why(), "none: no events");
}

/// The machinery itself, on a clock that needs no counter of the processor: nanoseconds of CPU time in the place of
/// cycles.
TEST(counters, see_the_phase_alone_and_the_threads_started_later) {
  counters c(std::vector{task_clock, impossible});
  if (!c.why().empty()) GTEST_SKIP() << c.why();
  EXPECT_EQ(c.description(), "task_clock");
  be_busy(milliseconds(200));  // before the phase
  for (int phase = 0; phase < 2; ++phase) {
    std::thread other;
    c.start();
    other = std::thread([] {
      const auto begin = std::clock();
      while (std::clock() - begin < CLOCKS_PER_SEC / 50) be_busy(milliseconds(1));
    });
    other.join();
    const auto n = c.stop();
    ASSERT_TRUE(n.cycles.has_value());
    EXPECT_GT(*n.cycles, 5'000'000u) << "the other thread's 20 ms";
    EXPECT_LT(*n.cycles, 190'000'000u) << "not the 200 ms before";
    EXPECT_FALSE(n.instructions) << "the impossible one";
    be_busy(milliseconds(200));  // between phases
  }
}

}  // namespace
}  // namespace pairsum::harness

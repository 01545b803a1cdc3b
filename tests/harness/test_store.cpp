#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"
#include "harness/measure/cpu_time.hpp"
#include "harness/measure/pass_times.hpp"
#include "harness/verify/pack.hpp"
#include "harness/verify/shared_store.hpp"

namespace pairsum::harness {
namespace {

TEST(shared_store, hands_bytes_to_whoever_has_the_descriptor) {
  shared_store mine;
  mine.save("a", "first");
  mine.save("b", std::string("\0x", 2));
  mine.save("a", "second");
  mine.save("empty", "");
  shared_store theirs(mine.descriptor());
  EXPECT_EQ(theirs.load("a"), "second");
  EXPECT_EQ(theirs.load("b"), std::string("\0x", 2));
  EXPECT_EQ(theirs.load("empty"), "");
  EXPECT_EQ(theirs.load("c"), std::nullopt);
  theirs.save("c", "new");
  EXPECT_EQ(mine.load("c"), "new");
}

TEST(shared_store, forgets_what_a_dead_process_began_to_save) {
  shared_store store;
  store.save("a", "whole");
  const std::size_t end = store.end();
  ASSERT_EQ(::write(store.descriptor(), "half a record", 13), 13);
  store.truncate(end);
  store.save("b", "after");
  EXPECT_EQ(store.load("a"), "whole");
  EXPECT_EQ(store.load("b"), "after");
}

TEST(shared_store, a_descriptor_that_is_none_is_refused) {
  EXPECT_THROW(shared_store(-1), error);
  EXPECT_THROW(shared_store(12345), error);
}

TEST(pack, expectations_and_verdicts_come_back_and_cut_ones_are_refused) {
  expectation e{{"drho", "dv_x"}, {3, 5}, {{1, 2}, {3, 4}}, {{0.1, 0.2}, {0.3, 0.4}}, {{5, 6}, {7, 8}}, 11, 12};
  const std::string bytes = pack(e);
  const expectation back = unpack_expectation(bytes);
  EXPECT_EQ(back.names, e.names);
  EXPECT_EQ(back.ids, e.ids);
  EXPECT_EQ(back.value, e.value);
  EXPECT_EQ(back.bound, e.bound);
  EXPECT_EQ(back.magnitude, e.magnitude);
  EXPECT_EQ(back.pairs_fluid_fluid, 11u);
  EXPECT_EQ(back.pairs_fluid_boundary, 12u);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(unpack_expectation(bytes.substr(0, size)), error) << size;
  verdict_map known;
  verdict v;
  v.max_rel_err = 0.25;
  v.bound = 0.5;
  known.insert({{{"euler", 2}, 77u}, v});
  const verdict_map again = unpack_verdicts(pack(known));
  ASSERT_EQ(again.size(), 1u);
  EXPECT_TRUE(again.begin()->first == known.begin()->first);
  EXPECT_TRUE(again.begin()->second.ok);
  EXPECT_EQ(again.begin()->second.bound, 0.5);
}

TEST(pass_times, work_and_waiting_make_up_the_pass) {
  pass_times times(2);
  EXPECT_FALSE(times.any());
  times.pass_begins(0);
  for (int chunk = 0; chunk < 2; ++chunk) {
    times.work_begins(0, 0);
    ::usleep(2000);
    times.work_ends(0, 0);
  }
  times.pass_ends(0);
  times.work_begins(1, 1);
  ::usleep(1000);
  times.work_ends(1, 1);
  times.pass_ends(1);
  const auto busy = times.busy(), waiting = times.waiting();
  ASSERT_EQ(busy.size(), 2u);
  EXPECT_GE(busy[0][0], 0.004);
  EXPECT_EQ(busy[0][1], 0);
  EXPECT_GE(busy[1][1], 0.001);
  EXPECT_EQ(busy[1][0], 0);
  for (std::size_t pass = 0; pass < 2; ++pass)
    EXPECT_NEAR(busy[pass][0] + waiting[pass][0], busy[pass][1] + waiting[pass][1], 1e-12) << "the pass's length";
  times.pass_begins(0);
  times.pass_ends(0);
  EXPECT_EQ(times.busy(), (pass_times::table{{0, 0}})) << "a new sum forgets the last";
}

TEST(cpu_time, others_have_what_is_left) {
  const machine_time before{100, 1000}, after{106, 1020};
  EXPECT_DOUBLE_EQ(*share_of_others(before, after, 5), 0.05);
  EXPECT_EQ(share_of_others(before, after, 9), 0.0) << "never below 0";
  EXPECT_EQ(share_of_others(before, before, 0), std::nullopt);
  EXPECT_EQ(share_of_others(std::nullopt, after, 0), std::nullopt);
  const auto now = machine_time_now();
  ASSERT_TRUE(now);
  EXPECT_GT(now->total_s, now->busy_s);
  EXPECT_GT(own_time(), 0);
}

}  // namespace
}  // namespace pairsum::harness

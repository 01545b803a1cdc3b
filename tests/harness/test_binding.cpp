#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <omp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

#include <pairsum/core/error.hpp>
#include <pairsum/core/tbb_arena.hpp>
#include "harness/measure/binding.hpp"
#include "harness/measure/worker_team.hpp"

namespace pairsum::harness {
namespace {

using units = std::vector<int>;

/// The units the calling thread may run on.
units mask() {
  cpu_set_t set;
  CPU_ZERO(&set);
  EXPECT_EQ(sched_getaffinity(0, sizeof set, &set), 0);
  units all;
  for (int u = 0; u < CPU_SETSIZE; ++u)
    if (CPU_ISSET(u, &set)) all.push_back(u);
  return all;
}

bool may_run_on(const units& wanted) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int u : wanted) CPU_SET(u, &set);
  return sched_setaffinity(0, sizeof set, &set) == 0;
}

/// The masks of all threads of an OpenMP region; a mask of one whose thread runs elsewhere counts as {-1}.
std::vector<units> masks_in_region(int threads) {
  std::vector<units> found(static_cast<std::size_t>(threads));
#pragma omp parallel num_threads(threads)
  {
    units own = mask();
    if (own.size() == 1 && sched_getcpu() != own.front()) own = {-1};
    found[static_cast<std::size_t>(omp_get_thread_num())] = own;
  }
  return found;
}

/// The masks of the threads in the slots of the arena, all of which work at the same time.
std::vector<units> masks_in_arena(const team& t) {
  std::vector<units> found(static_cast<std::size_t>(t.threads()));
  std::atomic<int> inside = 0;
  t.for_each(found.size(), [&](std::size_t) {
    ++inside;
    while (inside < t.threads()) sched_yield();  // none takes two
    units own = mask();
    if (own.size() == 1 && sched_getcpu() != own.front()) own = {-1};
    found[static_cast<std::size_t>(::tbb::this_task_arena::current_thread_index())] = own;
  });
  return found;
}

std::vector<units> expected(const thread_binding& b, int threads) {
  std::vector<units> one_each;
  for (int k = 0; k < threads; ++k) one_each.push_back({b.units()[static_cast<std::size_t>(k) % b.units().size()]});
  return one_each;
}

/// Runs f in a child process; true if f returns true there.
template <class F>
bool holds_in_child(F&& f) {
  const pid_t child = fork();
  if (child == 0) _exit(f() ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(cores_first, takes_one_unit_of_every_core_first) {
  EXPECT_EQ(cores_first({{0, 0, 0, 0}, {1, 0, 0, 0}, {2, 1, 0, 0}, {3, 1, 0, 0}}), (units{0, 2, 1, 3}));
  EXPECT_EQ(cores_first({{0, 0, 0, 0}, {4, 0, 0, 0}, {1, 1, 0, 0}, {5, 1, 0, 0}}), (units{0, 1, 4, 5}));
}

TEST(cores_first, alternates_over_packages_then_nodes) {
  // two packages of two nodes of two cores
  std::vector<unit_place> places;
  for (int u = 0; u < 8; ++u) places.push_back({u, u, u / 2, u / 4});
  EXPECT_EQ(cores_first(places), (units{0, 4, 2, 6, 1, 5, 3, 7}));
}

TEST(cores_first, of_uneven_cores) {
  EXPECT_EQ(cores_first({{1, 0, 0, 0}, {2, 1, 0, 0}, {3, 1, 0, 0}}), (units{1, 2, 3})) << "unit 0 was not given";
  EXPECT_EQ(cores_first({}), units{});
}

class binding_test : public testing::Test {
 protected:
  void SetUp() override {
    before_ = mask();
    if (binding.units().empty()) GTEST_SKIP() << binding.description();
  }
  void TearDown() override { EXPECT_EQ(mask(), before_) << "the caller is as free as before"; }
  const thread_binding binding;

 private:
  units before_;
};

TEST_F(binding_test, uses_every_unit_of_the_process_once) {
  units sorted = binding.units();
  std::ranges::sort(sorted);
  EXPECT_EQ(sorted, mask());
  std::string text = "cores_first ";
  for (std::size_t k = 0; k < binding.units().size(); ++k) text += (k ? "," : "") + std::to_string(binding.units()[k]);
  EXPECT_EQ(binding.description(), text);
}

TEST_F(binding_test, of_OpenMP_threads) {
  for (const int threads : {2, 1, 2, 5, 2}) {
    const worker_team team(runtime::omp, threads, &binding);
    EXPECT_EQ(masks_in_region(threads), expected(binding, threads)) << threads;
    EXPECT_EQ(masks_in_region(threads), expected(binding, threads)) << threads << ", a second region";
  }
}

TEST_F(binding_test, of_oneTBB_threads) {
  for (const int threads : {2, 1, 2, 5, 2}) {
    const worker_team team(runtime::tbb, threads, &binding);
    EXPECT_EQ(masks_in_arena(team.get()), expected(binding, threads)) << threads;
    EXPECT_EQ(masks_in_arena(team.get()), expected(binding, threads)) << threads << ", a second visit";
  }
}

TEST_F(binding_test, of_the_caller_of_serial_backends) {
  const worker_team team(runtime::serial, 1, &binding);
  EXPECT_EQ(mask(), units{binding.units().front()});
  EXPECT_EQ(sched_getcpu(), binding.units().front());
}

TEST_F(binding_test, does_not_outlive_its_team) {
  const units free = mask();
  for (const runtime kind : {runtime::serial, runtime::omp, runtime::tbb}) {
    { const worker_team team(kind, kind == runtime::serial ? 1 : 2, &binding); }
    EXPECT_EQ(mask(), free) << name_of(kind);
  }
  { const worker_team team(runtime::omp, 2, &binding); }
  const worker_team unbound(runtime::omp, 2);
  EXPECT_EQ(masks_in_region(2), (std::vector<units>{free, free}));
}

TEST_F(binding_test, stays_right_when_runtimes_take_turns) {
  for (int turn = 0; turn < 3; ++turn) {
    {
      const worker_team team(runtime::omp, 2, &binding);
      ASSERT_EQ(masks_in_region(2), expected(binding, 2)) << turn;
    }
    {
      const worker_team team(runtime::tbb, 2, &binding);
      ASSERT_EQ(masks_in_arena(team.get()), expected(binding, 2)) << turn;
    }
    const worker_team team(runtime::serial, 1, &binding);
    ASSERT_EQ(mask(), expected(binding, 1).front()) << turn;
  }
}

TEST(binding, keeps_to_the_units_the_process_was_given) {
  for (const int given : mask())
    EXPECT_TRUE(holds_in_child([&] {
      if (!may_run_on({given})) return false;
      const thread_binding b;
      return b.units() == units{given} && b.description() == "cores_first " + std::to_string(given) &&
             b.bind_this_thread(0) && b.bind_this_thread(1) && mask() == units{given};
    })) << given;
}

TEST(binding, none_binds_nothing) {
  const units free = mask();
  const thread_binding none("none");
  EXPECT_EQ(none.description(), "none");
  EXPECT_TRUE(none.units().empty());
  EXPECT_FALSE(none.bind_this_thread(0));
  const worker_team team(runtime::omp, 2, &none);
  EXPECT_EQ(masks_in_region(2), (std::vector<units>{free, free}));
}

TEST(binding, of_another_name_is_refused) {
  try {
    const thread_binding b("cores_last");
    FAIL();
  } catch (const error& e) {
    EXPECT_STREQ(e.what(), "unknown binding \"cores_last\"; did you mean cores_first? valid: cores_first, none");
  }
}

/// From now on the kernel refuses the calling process to bind threads.
bool refuse_to_bind() {
  sock_filter code[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_sched_setaffinity, 0, 1),
                        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
                        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program{static_cast<unsigned short>(std::size(code)), code};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

TEST(binding, failure_is_told) {
  const std::string told = "none: Operation not permitted";
  EXPECT_TRUE(holds_in_child([&] {
    if (!refuse_to_bind()) return true;
    const thread_binding b;
    return b.description() == told && b.units().empty() && !b.bind_this_thread(0);
  })) << "from the start";
  EXPECT_TRUE(holds_in_child([&] {
    const thread_binding b;
    if (b.units().empty() || !refuse_to_bind()) return true;
    return b.description() != told && !b.bind_this_thread(0) && b.description() == told;
  })) << "later";
}

TEST(worker_team, counts_the_threads_that_work_at_once) {
  using ::tbb::global_control;
  tbb_arena arena(3);
  const team three = team::tbb(3, arena);
  EXPECT_EQ(threads_at_once(three, std::chrono::seconds(10)), 3);
  EXPECT_EQ(threads_at_once(team(), std::chrono::seconds(10)), 1);
  const global_control limit(global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(threads_at_once(three, std::chrono::milliseconds(100)), 1);
}

TEST(worker_team, is_not_made_smaller_by_another_that_lives) {
  tbb_arena five(5);
  {
    const tbb_arena one(1), three(3);
    EXPECT_EQ(threads_at_once(team::tbb(5, five), std::chrono::seconds(10)), 5);
  }
  EXPECT_EQ(threads_at_once(team::tbb(5, five), std::chrono::seconds(10)), 5);
}

/// By a program that holds pairsum, for example.
TEST(worker_team, that_gets_fewer_threads_is_refused) {
  using ::tbb::global_control;
  std::string refusal;
  try {
    const global_control limit(global_control::max_allowed_parallelism, 1);
    const worker_team two(runtime::tbb, 2);
  } catch (const error& e) {
    refusal = e.what();
  }
  EXPECT_EQ(refusal,
            "oneTBB gives 1 of 2 threads; end or raise the tbb::global_control that limits max_allowed_parallelism");
  const worker_team two(runtime::tbb, 2);
}

}  // namespace
}  // namespace pairsum::harness

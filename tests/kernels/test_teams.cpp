#include <gtest/gtest.h>

#include <omp.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <pairsum/core/tbb_arena.hpp>
#include <pairsum/sum/schedule.hpp>
#include "scene.hpp"

// Teams that a sum cannot have: of the wrong kind, larger than the one that prepared, smaller than asked for.
namespace pairsum {
namespace {

using namespace test_kit;

class teams_test : public testing::TestWithParam<std::string> {
 protected:
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  const backend_traits& traits = registry::instance().find_backend(GetParam()).traits;
  std::unique_ptr<summation> sum = registry::instance().make_summation(with(s.world, GetParam(), 4));

  void SetUp() override { sum->load(s.particles, {}); }
  static constexpr void (summation::*phases[])(const team&) = {&summation::prepare, &summation::zero, &summation::sum,
                                                               &summation::reduce};
};
INSTANTIATE_TEST_SUITE_P(backend, teams_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

TEST_P(teams_test, of_the_wrong_kind_are_refused) {
  const bool tbb = traits.threads == runtime::tbb;
  const workers right(traits.threads, 2), other(tbb ? runtime::omp : runtime::tbb, 2);
  const std::string name = GetParam();
  const std::string refusal = traits.threads == runtime::serial ? ""
                              : tbb ? "backend " + name + " sums with a team of tbb threads, got one of omp"
                                    : "backend " + name + " sums with a team of omp threads, got one of tbb";
  sum->index(right.get());
  for (const auto phase : phases) {
    EXPECT_EQ(error_of([&] { (sum.get()->*phase)(other.get()); }), refusal);
    (sum.get()->*phase)(right.get());
  }
  if (traits.deterministic && traits.threads != runtime::serial) {
    EXPECT_EQ(sum->fingerprint(), evaluated(with(s.world, name, 4), s.particles)->fingerprint());
  }
}

TEST_P(teams_test, larger_than_prepared_are_refused) {
  const workers one(traits.threads, 1), three(traits.threads, 3);
  sum->index(three.get());
  sum->prepare(one.get());
  sum->zero(one.get());
  EXPECT_EQ(error_of([&] { sum->sum(three.get()); }), "prepared for 1 threads, but summed on 3");
  sum->sum(one.get());
  sum->reduce(one.get());
  if (traits.deterministic) {
    EXPECT_EQ(sum->fingerprint(), evaluated(with(s.world, GetParam(), 4), s.particles)->fingerprint());
  }
}

/// In a parallel region of the caller's, where OpenMP gives one thread.
TEST_P(teams_test, of_openmp_that_come_out_smaller_are_an_error) {
  if (traits.threads != runtime::omp) GTEST_SKIP() << "no OpenMP";
  const workers three(runtime::omp, 3);
  sum->index(three.get());
  sum->prepare(three.get());
  sum->zero(three.get());
  const int levels = omp_get_max_active_levels();
  omp_set_max_active_levels(1);
  std::string refusal;
#pragma omp parallel num_threads(2)
#pragma omp single
  refusal = error_of([&] { sum->sum(three.get()); });
  omp_set_max_active_levels(levels);
  EXPECT_TRUE(says(refusal, {"OpenMP gave 1 of 3 threads", "OMP_THREAD_LIMIT"})) << refusal;
  sum->sum(three.get());
  sum->reduce(three.get());
  if (traits.deterministic) {
    EXPECT_EQ(sum->fingerprint(), evaluated(with(s.world, GetParam(), 4), s.particles)->fingerprint());
  }
}

TEST_P(teams_test, of_onetbb_that_come_out_smaller_are_an_error) {
  if (traits.threads != runtime::tbb) GTEST_SKIP() << "no oneTBB";
  const workers three(runtime::tbb, 3);
  sum->index(three.get());
  sum->prepare(three.get());
  sum->zero(three.get());
  std::string refusal, refused_workers;
  {
    using ::tbb::global_control;
    const global_control two(global_control::max_allowed_parallelism, 2);
    refusal = error_of([&] { sum->sum(three.get()); });
    refused_workers = error_of([] { workers(runtime::tbb, 3); });
  }
  EXPECT_TRUE(says(refusal, {"oneTBB gives 2 of 3 threads", "global_control"})) << refusal;
  EXPECT_EQ(refused_workers, refusal);
  sum->sum(three.get());
  sum->reduce(three.get());
}

/// As a user with a low ulimit -u: OpenMP would end the process.
TEST(teams, that_the_system_does_not_give_are_an_error) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit one{1, 1};
    if ((getuid() == 0 && setuid(54321) != 0) || setrlimit(RLIMIT_NPROC, &one) != 0) _exit(77);
    const auto refused = [](runtime r) {
      return says(error_of([&] { workers(r, 100); }), {"the system gives 1 of 100 threads", "ulimit -u"});
    };
    _exit(refused(runtime::omp) && refused(runtime::tbb) ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "this user cannot be another";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(teams, of_fewer_threads_than_their_arena_are_refused) {
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  const auto sum = registry::instance().make_summation(with(s.world, "touched_blocks_tbb", 4));
  tbb_arena arena(3);
  const team two = team::tbb(2, arena);
  sum->load(s.particles, {});
  sum->index(two);
  sum->prepare(two);
  sum->zero(two);
  EXPECT_TRUE(says(error_of([&] { sum->sum(two); }), {"a team of 2 oneTBB threads has an arena of 3"}));
}

/// A gather whose traits say nothing of how its units are shared out.
template <int D, class R>
class says_no_loop final : public schedule<D, R> {
 public:
  static constexpr backend_traits traits{.symmetric = false, .conflicts = conflict_avoidance::gather};
  std::size_t size(const problem<D, R>& p, unsigned) const override { return p.cells().fluid_cells; }
  void unit(const problem<D, R>& p, unsigned, std::size_t k, int thread) override {
    sum_meetings(p, p.to(thread), full_stencil(p.cells(), k + 1));
  }
};

TEST(teams, share_out_loops_that_the_backend_does_not) {
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  registry all = registry::instance();
  for (const runtime r : {runtime::serial, runtime::omp, runtime::tbb}) {
    const std::string_view name = r == runtime::serial ? "no_loop" : r == runtime::omp ? "no_loop_omp" : "no_loop_tbb";
    all.add(backend_entry::of<says_no_loop>(name, r));
    const auto sum = all.make_summation(with(s.world, std::string(name), 4));
    const workers two(r, 2);
    sum->load(s.particles, {});
    sum->evaluate(two.get());
    EXPECT_EQ(sum->fingerprint(), evaluated(with(s.world, "naive", 4), s.particles)->fingerprint()) << name;
  }
}

}  // namespace
}  // namespace pairsum

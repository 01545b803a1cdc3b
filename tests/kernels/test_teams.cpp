#include <gtest/gtest.h>

#include <omp.h>

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
  EXPECT_EQ(error_of([&] { sum->sum(three.get()); }), "prepared for 1 threads, but to be summed on 3");
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

}  // namespace
}  // namespace pairsum

#include "harness/model/cost.hpp"

#include <gtest/gtest.h>

#include "scene.hpp"

namespace pairsum::harness {
namespace {

/// 100 fluid particles of 80 bytes with rates of 32, 1000 pairs in reach of 5000 tested; machine of 10 GB/s, 1 Gflop/s.
cost_question question() {
  cost_question q;
  q.formula = {.dim = 3,
               .distance_test = 9,
               .counted = {.both = 40, .one_sided = 30, .boundary = 20},
               .declared = {},
               .boundary_reach = 1,
               .fluid_bytes = 80,
               .boundary_bytes = 48,
               .rates_bytes = 32};
  q.backend = {.name = "gather", .symmetric = false};
  q.work.pairs_tested = 5000;
  q.work.pairs_fluid_fluid = 1000;
  q.work.pairs_fluid_boundary = 10;
  q.n_fluid = 100;
  q.n_boundary = 50;
  q.peaks = {.bandwidth_bytes_per_s = 1e10, .flops_per_s = 1e9};
  return q;
}

backend_traits passes() {
  backend_traits t = question().backend;
  t.symmetric = t.sweeps_per_colour = true;
  t.colours = {2, 4, 8};
  return t;
}

TEST(cost, of_a_gather) {
  const cost_bound b = bound_of(question());
  EXPECT_EQ(b.flops, 5000 * 9 + 2 * 1000 * 30 + 10 * 20);
  EXPECT_EQ(b.bytes, 100 * (80 + 32));
  EXPECT_DOUBLE_EQ(b.intensity, b.flops / b.bytes);
  EXPECT_DOUBLE_EQ(b.bound_s, b.flops / 1e9);
  EXPECT_EQ(b.limited_by, "flops");
  EXPECT_DOUBLE_EQ(b.share_of_bound(4 * b.bound_s), 0.25);
  EXPECT_DOUBLE_EQ(b.achieved_flops_per_s(2), b.flops / 2);
}

TEST(cost, of_coloured_passes) {
  cost_question q = question();
  q.backend = passes();
  cost_bound b = bound_of(q);
  EXPECT_EQ(b.flops, 5000 * 9 + 1000 * 40 + 10 * 20);
  EXPECT_EQ(b.bytes, 8 * 100 * (80 + 2 * 32)) << "no cache holds it";
  q.formula.dim = 2;
  EXPECT_EQ(bound_of(q).bytes, 4 * 100 * (80 + 2 * 32));
  q.last_level_cache_bytes = 100 * (80 + 32);
  EXPECT_EQ(bound_of(q).bytes, 100 * (80 + 2 * 32)) << "it fits";
}

TEST(cost, of_a_list_tests_no_distance_and_reads_the_list) {
  cost_question q = question();
  q.backend = passes();
  q.backend.sweeps_per_colour = false;
  q.backend.keeps_pairs = true;
  const cost_bound b = bound_of(q);
  EXPECT_EQ(b.flops, 1000 * (40 + 8) + 10 * (20 + 8));
  EXPECT_EQ(b.bytes, 100 * (80 + 2 * 32) + 1000 * 4);
}

TEST(cost, leaves_out_what_was_not_counted) {
  cost_question q = question();
  q.formula.boundary_reach = 0.5;
  EXPECT_EQ(bound_of(q).flops, 5000 * 9 + 2 * 1000 * 30) << "the pairs within H/2 are unknown";
  q.formula.boundary_reach = 0;
  EXPECT_EQ(bound_of(q).flops, 2 * 1000 * (30 + 9)) << "tests with the boundary were not made";
  q.n_boundary = 0;
  EXPECT_EQ(bound_of(q).flops, 5000 * 9 + 2 * 1000 * 30) << "there is none";
}

TEST(cost, is_limited_by_the_slower_of_the_two) {
  cost_question q = question();
  q.peaks.bandwidth_bytes_per_s = 1e6;
  const cost_bound b = bound_of(q);
  EXPECT_EQ(b.limited_by, "bandwidth");
  EXPECT_DOUBLE_EQ(b.bound_s, b.bytes / 1e6);
  q.peaks = {};
  EXPECT_EQ(bound_of(q).bound_s, 0) << "peaks are unknown";
  EXPECT_EQ(bound_of(q).limited_by, "");
}

class declared_evaluations_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(backend, declared_evaluations_test, testing::ValuesIn(test_kit::backend_names()),
                         [](const auto& i) { return i.param; });

TEST_P(declared_evaluations_test, are_those_counted) {
  const test_kit::scene s = test_kit::make_scene("dam_break", 0.05, "perturbed");
  for (const int M : {2, 5}) {
    const auto sum = test_kit::evaluated(test_kit::with(s.world, GetParam(), M), s.particles);
    const work_counts n = sum->count_work();
    EXPECT_EQ(contradiction(sum->traits(), n), "");
    EXPECT_GT(n.pairs_evaluated, n.pairs_fluid_fluid);
    EXPECT_GT(n.pairs_fluid_boundary, 0u);
    backend_traits lie = sum->traits();
    lie.symmetric = !lie.symmetric;
    EXPECT_NE(contradiction(lie, n), "") << "a gather that says once, passes that say twice";
  }
}

TEST(declared_evaluations, of_a_lie_are_named) {
  backend_traits lie = passes();
  const work_counts gathered{.pairs_fluid_fluid = 1000, .pairs_fluid_boundary = 10, .pairs_evaluated = 2010};
  EXPECT_EQ(contradiction(lie, gathered),
            "gather evaluates the formula 2010 times; by its evaluations_per_pair of 1 it would be 1010");
}

}  // namespace
}  // namespace pairsum::harness

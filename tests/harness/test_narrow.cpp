#include <gtest/gtest.h>

#include "harness/plan/narrow.hpp"
#include "study_fixture.hpp"

namespace pairsum::harness {
namespace {

study_plan two_parts() {
  study_plan plan = study_of({small_part("a", 1), small_part("b", 1)});
  plan.parts[0].request.backends = {"naive", "symmetric_omp"};
  plan.parts[0].request.M = {3, 4};
  plan.parts[1].request.dx = {0.05, 0.1};
  return plan;
}

study_plan narrowed(const std::vector<std::string>& only) {
  study_plan plan = two_parts();
  narrow(plan, only, 2);
  return plan;
}

TEST(narrow, leaves_values_and_the_parts_that_have_some) {
  EXPECT_EQ(plan_hash(narrowed({})), plan_hash(two_parts()));
  const study_plan plan = narrowed({"backend=symmetric_omp"});
  ASSERT_EQ(plan.parts.size(), 1u);
  EXPECT_EQ(plan.parts[0].request.backends, std::vector<std::string>{"symmetric_omp"});
  EXPECT_EQ(plan.parts[0].request.M, (std::vector<int>{3, 4}));
  EXPECT_NE(plan_hash(plan), plan_hash(two_parts()));
}

TEST(narrow, takes_ranges_numbers_and_the_same_level_twice) {
  EXPECT_EQ(narrowed({"M=3..4"}).parts[0].request.M, (std::vector<int>{3, 4}));
  EXPECT_EQ(narrowed({"dx=0.050"}).parts[0].request.dx, std::vector<double>{0.05});
  EXPECT_EQ(narrowed({"backend=naive", "backend=symmetric_omp"}).parts[0].request.backends.size(), 2u);
  EXPECT_EQ(narrowed({"state=perturbed", "case=dam_break"}).parts.size(), 2u);
}

TEST(narrow, names_what_the_plan_has) {
  const auto said = [](const std::vector<std::string>& only) { return refusal_of([&] { narrowed(only); }); };
  EXPECT_EQ(said({"backend=naive,nope"}), "the plan test has no backend nope; it has naive, symmetric_omp");
  EXPECT_EQ(said({"M=5"}), "the plan test has no M 5; it has 3, 4");
  EXPECT_EQ(said({"dx=0.2"}), "the plan test has no dx 0.2; it has 0.1, 0.05");
  EXPECT_NE(said({"colour=red"}).find("unknown level of --only \"colour\"; valid: B, H, M, backend"),
            std::string::npos);
  EXPECT_NE(said({"backend"}).find("like backend=naive, not \"backend\""), std::string::npos);
  EXPECT_NE(said({"backend="}).find("--only backend"), std::string::npos);
  EXPECT_NE(said({"M=x"}).find("--only M takes"), std::string::npos);
  EXPECT_EQ(said({"backend=symmetric_omp", "dx=0.05"}),
            "no part of the plan test has backend=symmetric_omp, dx=0.05 together");
}

}  // namespace
}  // namespace pairsum::harness

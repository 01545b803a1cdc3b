#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/plan/study.hpp"
#include "harness/run/worker.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

json valid() {
  return json::parse(R"({"schema": "pairsum.plan/1", "study": "s", "title": "t", "budget_s": 60, "peaks": false,
    "self_test": false, "builds": 1, "seed": 3, "defaults": {"steps": 2, "M": "6..7", "backend": "symmetric_omp"},
    "parts": [{"name": "a", "reason": "r", "threads": "all", "rounds": [2, 9], "half_width": 0.02},
              {"name": "b", "dx": [0.02, 0.03], "rounds": 4, "share": 2}]})");
}

/// Accepts a plan for a machine of 4 cores.
study_plan accepted(const json& j) {
  study_plan plan = parse_plan(j, 4);
  check_plan(plan, registry_of(plan));
  return plan;
}

TEST(study, shipped_plans_parse_and_come_back_the_same) {
  EXPECT_GE(shipped_plans().size(), 7u);
  for (const shipped_plan& shipped : shipped_plans()) {
    const study_plan plan = parse_plan(load_plan(std::string(shipped.name)), 4);
    EXPECT_EQ(plan.study, shipped.name);
    EXPECT_FALSE(plan.title.empty());
    for (const part_plan& p : plan.parts) EXPECT_FALSE(p.reason.empty()) << plan.study << " " << p.request.part;
    const json written = plan_json(plan);
    const study_plan back = parse_plan(written, 64);  // every number is said: other cores change nothing
    EXPECT_EQ(plan_json(back), written);
    EXPECT_EQ(plan_hash(back), plan_hash(plan));
    const registry& all = registry_of(plan);
    try {
      check_plan(plan, all);
    } catch (const error& e) {  // a small build lacks words; nothing else may be wrong
      EXPECT_NE(std::string(e.what()).find("build"), std::string::npos) << plan.study << ": " << e.what();
    }
  }
}

TEST(study, defaults_hold_for_every_part_that_does_not_say_otherwise) {
  const study_plan plan = accepted(valid());
  ASSERT_EQ(plan.parts.size(), 2u);
  const auto& [a, b] = std::tie(plan.parts[0], plan.parts[1]);
  EXPECT_EQ(a.request.threads, (std::vector<int>{1, 2, 4}));
  EXPECT_EQ(a.request.M, (std::vector<int>{6, 7}));
  EXPECT_EQ(a.least_rounds, 2);
  EXPECT_EQ(a.most_rounds, 9);
  EXPECT_EQ(a.half_width, 0.02);
  EXPECT_EQ(b.request.dx, (std::vector<double>{0.02, 0.03}));
  EXPECT_EQ(b.least_rounds, 4);
  EXPECT_EQ(b.most_rounds, 4);
  EXPECT_EQ(b.share, 2);
  for (const part_plan& p : plan.parts) {
    EXPECT_EQ(p.request.steps, 2);
    EXPECT_EQ(p.request.seed, 3u);
    EXPECT_EQ(p.request.study, "s");
  }
}

TEST(study, the_hash_ignores_the_budget_and_nothing_else) {
  const std::string hash = plan_hash(accepted(valid()));
  EXPECT_EQ(hash.size(), 16u);
  json j = valid();
  j["budget_s"] = 7;
  EXPECT_EQ(plan_hash(accepted(j)), hash);
  std::set<std::string> hashes{hash};
  const auto changed = [&](const char* path, const json& value) {
    j = valid();
    j[json::json_pointer(path)] = value;
    EXPECT_TRUE(hashes.insert(plan_hash(accepted(j))).second) << path;
  };
  changed("/study", "other");
  changed("/title", "other");
  changed("/peaks", true);
  changed("/self_test", true);
  changed("/builds", 2);
  changed("/seed", 4);
  changed("/defaults/steps", 3);
  changed("/parts/0/name", "c");
  changed("/parts/0/reason", "other");
  changed("/parts/0/threads", "1");
  changed("/parts/0/rounds/0", 3);
  changed("/parts/0/rounds/1", 10);
  changed("/parts/0/half_width", 0.03);
  changed("/parts/1/share", 3);
  changed("/parts/1/repetitions", 2);
  changed("/parts/1/granularity", "static:0");
}

}  // namespace
}  // namespace pairsum::harness

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include <pairsum/core/error.hpp>
#include "harness/plan/study.hpp"
#include "harness/plan/variants.hpp"
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
  EXPECT_GE(shipped_plans().size(), 9u);
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

/// What a study of the field lacks: every backend that can be used, six rounds, worlds to compare, a sparse and a plane
/// one; empty if nothing.
std::string fault_of_field(const study_plan& plan) {
  std::set<std::string> backends;
  for (const backend_entry& b : registry::instance().backends())
    if (b.unavailable.empty()) backends.emplace(b.traits.name);
  std::set<int> dims;
  std::map<std::string, std::set<double>> reaches;
  for (const part_plan& p : plan.parts) {
    const run_request& r = p.request;
    if (std::set<std::string>(r.backends.begin(), r.backends.end()) != backends) return r.part + " lacks backends";
    if (p.least_rounds < 6) return r.part + " has no intervals";
    if (r.threads.size() < 2) return r.part + " does not go over threads";
    if (r.states != std::vector<std::string>{"perturbed"}) return r.part + " proves little at rest";
    dims.insert(r.dim);
    reaches[r.case_name].insert(r.H);
  }
  if (dims != std::set<int>{2, 3}) return "2D and 3D are not compared";
  if (!reaches.contains("periodic_lattice")) return "no periodic world";
  if (!reaches.contains("dam_break") || reaches["random_clustered"].size() < 2) return "no sparse world";
  return "";
}

TEST(study, field_takes_every_backend_into_every_world) {
  const json j = load_plan("field");
  EXPECT_EQ(fault_of_field(parse_plan(j, 4)), "");
  const auto faulty = [&](const char* path, const json& value) {
    json changed = j;
    changed[json::json_pointer(path)] = value;
    EXPECT_NE(fault_of_field(parse_plan(changed, 4)), "") << path;
  };
  faulty("/parts/0/backend", "naive_omp,symmetric_omp");
  faulty("/defaults/rounds", 5);
  faulty("/defaults/threads", 1);
  faulty("/defaults/state", "rest");
  faulty("/parts/3/dim", 3);
  faulty("/parts/2/H", 0.0215);
  faulty("/parts/4/case", "lattice");
}

TEST(study, a_serial_backend_of_the_field_is_measured_once_per_world) {
  const study_plan plan = parse_plan(load_plan("field"), 4);
  for (const world_plan& points : expand(plan.parts.front().request))
    for (const char* serial : {"naive", "sphysics_sweep"})
      EXPECT_EQ(std::ranges::count(points, serial, &point::backend), 1) << serial;
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

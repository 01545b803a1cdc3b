#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/plan/levels.hpp"
#include "study_fixture.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

json plan_text() {
  return json::parse(R"({"schema":"pairsum.plan/1","study":"mine","title":"Mine","budget_s":60,"seed":7,
    "defaults":{"dx":0.08,"M":"4..6","threads":"all","rounds":[3,9],"half_width":0.02},
    "parts":[{"name":"a","reason":"because","backend":["naive_omp","symmetric_omp"]},
             {"name":"b","backend":"naive","M":5,"rounds":4,"share":2}]})");
}

TEST(study_plan, levels_are_read_as_on_the_command_line) {
  const study_plan plan = parse_plan(plan_text(), 6);
  ASSERT_EQ(plan.parts.size(), 2u);
  const part_plan &a = plan.parts[0], &b = plan.parts[1];
  EXPECT_EQ(a.request.study, "mine");
  EXPECT_EQ(a.request.part, "a");
  EXPECT_EQ(a.reason, "because");
  EXPECT_EQ(a.request.M, (std::vector<int>{4, 5, 6}));
  EXPECT_EQ(a.request.threads, (std::vector<int>{1, 2, 4, 6}));
  EXPECT_EQ(a.request.seed, 7u);
  EXPECT_EQ(a.least_rounds, 3);
  EXPECT_EQ(a.most_rounds, 9);
  EXPECT_EQ(b.request.M, std::vector<int>{5});
  EXPECT_EQ(b.least_rounds, 4);
  EXPECT_EQ(b.most_rounds, 4);
  EXPECT_EQ(b.share, 2);
  EXPECT_EQ(b.half_width, 0.02);
}

TEST(study_plan, a_plan_survives_its_json_and_has_a_hash_of_all_but_the_budget) {
  const study_plan plan = parse_plan(plan_text(), 2);
  EXPECT_EQ(plan_json(parse_plan(plan_json(plan), 16)), plan_json(plan));
  study_plan other = plan;
  other.budget_s = 1;
  EXPECT_EQ(plan_hash(other), plan_hash(plan));
  other.parts[1].request.M = {6};
  EXPECT_NE(plan_hash(other), plan_hash(plan));
  EXPECT_EQ(plan_hash(plan).size(), 16u);
}

TEST(study_plan, every_shipped_plan_can_be_measured) {
  std::vector<std::string> names;
  for (const shipped_plan& p : shipped_plans()) {
    names.emplace_back(p.name);
    const study_plan plan = parse_plan(load_plan(names.back()), 4);
    EXPECT_EQ(plan.study, p.name);
    EXPECT_FALSE(plan.title.empty());
    EXPECT_NO_THROW(check_plan(plan, registry_of(plan))) << p.name;
    for (const part_plan& part : plan.parts) EXPECT_FALSE(part.reason.empty()) << p.name << " " << part.request.part;
    EXPECT_EQ(plan_json(parse_plan(plan_json(plan), 1)), plan_json(plan)) << p.name;
  }
  for (const char* name : {"talk", "m_sweep", "quick", "granularity", "size", "compilers", "self_test"})
    EXPECT_NE(std::ranges::find(names, name), names.end()) << name;
}

void expect_refused(const std::string& pointer, const json& value, const std::string& says) {
  json plan = plan_text();
  plan[json::json_pointer(pointer)] = value;
  const std::string what = refusal_of([&] {
    const study_plan p = parse_plan(plan, 2);
    check_plan(p);
  });
  EXPECT_NE(what.find(says), std::string::npos) << pointer << " = " << value << ": " << what;
  EXPECT_EQ(what.find('\n'), std::string::npos);
}

TEST(study_plan, wrong_plans_are_refused_in_one_line_that_names_the_key) {
  expect_refused("/schema", "pairsum.plan/9", "\"schema\" should be \"pairsum.plan/1\"");
  expect_refused("/study", 1, "\"study\" should be a text");
  expect_refused("/study", "../x", "study's name");
  expect_refused("/parts", json::array(), "at least one part");
  expect_refused("/parts", 3, "\"parts\"");
  expect_refused("/note", 1, "\"note\" is not known");
  expect_refused("/parts/0/note", 1, "\"note\" is not known; levels are H, M, backend");
  expect_refused("/parts/0/rounds", json::array({3, 2}), "\"rounds\"");
  expect_refused("/parts/0/rounds", 0, "\"rounds\"");
  expect_refused("/parts/0/share", 0, "\"share\"");
  expect_refused("/parts/0/half_width", -1, "\"half_width\"");
  expect_refused("/parts/1/name", "a", "two parts of the plan are named \"a\"");
  expect_refused("/parts/0/backend", "nope", "unknown backend \"nope\"");
  expect_refused("/parts/0/M", 1, "one cell");
  expect_refused("/parts/0/M", "5..x", "\"M\"");
  expect_refused("/parts/0/dx", true, "\"dx\"");
  expect_refused("/parts/0/granularity", "auto:8", "granularity of OpenMP");
  expect_refused("/peaks", 1, "\"peaks\" should be true or false");
  expect_refused("/builds", 0, "\"builds\"");
  expect_refused("/defaults", 3, "\"defaults\" should be an object");
  EXPECT_NE(refusal_of([] { parse_plan(json::array(), 1); }), "");
  EXPECT_NE(refusal_of([] { load_plan("nope"); }).find("valid: compilers"), std::string::npos);
  EXPECT_NE(refusal_of([] { load_plan("/nowhere/plan.json"); }).find("cannot be read"), std::string::npos);
}

}  // namespace
}  // namespace pairsum::harness

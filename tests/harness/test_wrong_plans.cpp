#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include "harness/plan/study.hpp"
#include "harness/run/order.hpp"
#include "study_fixture.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

const json right_plan =
    json::parse(R"({"schema": "pairsum.plan/1", "study": "s", "defaults": {"backend": "symmetric_omp"},
  "parts": [{"name": "a"}, {"name": "b"}]})");

/// Refused in one line that says `says`.
template <class F>
void expect_refused(F&& f, const std::string& says, const std::string& what) {
  try {
    f();
    ADD_FAILURE() << "accepted " << what;
  } catch (const error& e) {
    EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << what << ": " << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
  }
}

void expect_refused(const json& plan, const std::string& says) {
  expect_refused([&] { check_plan(parse_plan(plan, 2)); }, says, plan.dump());
}

/// With one key changed, or added.
void expect_refused(const char* path, const json& value, const std::string& says) {
  json j = right_plan;
  j[json::json_pointer(path)] = value;
  expect_refused(j, says);
}

TEST(wrong_plan, is_refused_by_the_key_that_is_wrong) {
  EXPECT_NO_THROW(check_plan(parse_plan(right_plan, 2)));
  expect_refused(json::array(), "object");
  expect_refused("text", "object");
  expect_refused("/schema", "pairsum.plan/2", "\"schema\" should be \"pairsum.plan/1\"");
  expect_refused("/schema", 1, "\"schema\"");
  expect_refused("/steps", 3, "\"steps\" is not known");
  expect_refused("/defaults/step", 3, "\"step\" is not known");
  expect_refused("/parts/0/backends", "naive", "\"backends\" is not known; did you mean backend? there are name, ");
  expect_refused("/defaults/half_witdh", 0.1, "did you mean half_width?");
  expect_refused("/bugdet_s", 3, "did you mean budget_s? there are schema, ");
  expect_refused("/colour", 3, "\"colour\" is not known; there are schema, ");
  expect_refused("/study", "", "\"study\"");
  expect_refused("/study", 3, "\"study\"");
  expect_refused("/study", "a/b", "no slash");
  expect_refused("/study", "a\nb", "\"study\" should be a text without control characters");
  expect_refused("/title", 3, "\"title\"");
  expect_refused("/title", "\x1b[31m", "\"title\" should be a text without control characters");
  expect_refused("/budget_s", "60", "\"budget_s\"");
  expect_refused("/budget_s", -1, "\"budget_s\"");
  expect_refused("/peaks", 1, "\"peaks\"");
  expect_refused("/self_test", "yes", "\"self_test\"");
  for (const json& bad : {json(0), json(10), json(1.5), json("2")}) expect_refused("/builds", bad, "\"builds\"");
  expect_refused("/seed", -1, "\"seed\"");
  expect_refused("/seed", json::object(), "\"seed\"");
  expect_refused("/defaults", json::array(), "\"defaults\"");
}

TEST(wrong_plan, is_refused_for_its_parts) {
  expect_refused("/parts", json::array(), "at least one part");
  expect_refused("/parts", json::object(), "at least one part");
  expect_refused("/parts/0", 7, "\"parts\"");
  expect_refused("/parts/0/name", "", "needs a \"name\"");
  expect_refused("/parts/0/name", 3, "\"name\"");
  expect_refused("/parts/0/name", "b", "two parts of the plan are named \"b\"");
  expect_refused("/parts/0/reason", 3, "\"reason\"");
  for (const json& bad : {json(0), json(-1), json(1.5), json("6"), json({3, 2}), json({1, 2, 3}), json({0, 2}),
                          json::array(), json(18446744073709551615u)})
    expect_refused("/parts/0/rounds", bad, "\"rounds\"");
  for (const json& bad : {json(-0.1), json("0.1"), json()})
    expect_refused("/parts/0/half_width", bad, "\"half_width\"");
  for (const json& bad : {json(0), json("1")}) expect_refused("/parts/0/share", bad, "\"share\"");
  json no_parts = right_plan;
  no_parts.erase("parts");
  expect_refused(no_parts, "\"parts\"");
}

TEST(wrong_plan, is_refused_for_its_levels) {
  expect_refused("/parts/0/backend", "nope", "valid: ");
  expect_refused("/parts/0/backend", "all,naive", "unknown backend \"all\"");
  expect_refused("/parts/0/backend", json::array(), "\"backend\"");
  expect_refused("/parts/0/backend", {"naive", 3.5}, "3.5");
  expect_refused("/parts/0/backend", json::object(), "\"backend\"");
  expect_refused("/parts/0/backend", true, "\"backend\"");
  expect_refused("/parts/0/granularity", "auto:8", "auto:8");  // oneTBB's, for an OpenMP backend
  expect_refused("/parts/0/granularity", "dynamic:-1", "dynamic:-1");
  expect_refused("/parts/0/M", 1, "between 2 and 10");
  expect_refused("/parts/0/M", 6.5, "\"M\"");
  expect_refused("/parts/0/M", "9..5", "\"M\"");
  expect_refused("/parts/0/threads", 0, "threads must be at least 1");
  expect_refused("/parts/0/threads", "some", "\"threads\"");
  expect_refused("/parts/0/dx", -1, "dx must be");
  expect_refused("/parts/0/dx", "wide", "\"dx\"");
  expect_refused("/parts/0/steps", 0, "steps must be");
  expect_refused("/parts/0/steps", {5, 6}, "\"steps\" takes one number");
  expect_refused("/parts/0/repetitions", 0, "repetitions must be");
  expect_refused("/parts/0/state", "awake", "valid: rest");
  expect_refused("/parts/0/case", {"dam_break", "lattice"}, "valid: dam_break");
}

using plan_file = study_test;

TEST_F(plan_file, is_refused_by_its_name) {
  const auto refused = [&](const std::string& word, const std::string& says) {
    expect_refused([&] { load_plan(word); }, says, word);
  };
  refused("qick", "quick");
  refused((folder_ / "none.json").string(), "none.json: cannot be read");
  std::filesystem::create_directories(folder_ / "folder.json");
  refused((folder_ / "folder.json").string(), "is a folder");
  for (const char* text :
       {"{", "{\"schema\": \"pairsum.plan/1\", \"stu", "\x01\x02", "{}}", "{\"study\": 1, \"study\": 2}"}) {
    write_text(folder_ / "wrong.json", text);
    refused((folder_ / "wrong.json").string(), "wrong.json:1:");
  }
}

TEST(wrong_order, of_another_version_or_of_a_person_is_refused) {
  order o;
  o.plan = parse_plan(right_plan, 1);
  o.what = errand::verify;
  o.round = 7;
  json j = order_json(o);
  EXPECT_EQ(parse_order(j).round, 7);
  EXPECT_EQ(parse_order(j).what, errand::verify);
  EXPECT_EQ(plan_hash(parse_order(j).plan), plan_hash(o.plan));
  j["schema"] = "pairsum.order/0";
  expect_refused([&] { parse_order(j); }, "another version", "an old order");
  expect_refused([&] { parse_order(json::array()); }, "another version", "a list");
  j = order_json(o);
  j["part"] = 2;
  expect_refused([&] { parse_order(j); }, "another version", "a part that is not there");
  j = order_json(o);
  j["what"] = "dance";
  expect_refused([&] { parse_order(j); }, "another version", "an errand that is not known");
}

}  // namespace
}  // namespace pairsum::harness

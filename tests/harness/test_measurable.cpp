#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/core/isa.hpp>
#include "harness/plan/study.hpp"
#include "harness/plan/variants.hpp"
#include "harness/run/dry_run.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;
using texts = std::vector<std::string>;

/// The library as if words were known that were not built.
registry lacking() {
  registry r = registry::instance();
  r.add_missing({"precision", "quadruple", "PAIRSUM_PRECISIONS"});
  r.add_missing({"dimension", "4", "PAIRSUM_DIMS"});
  backend_entry gone = r.find_backend("naive");
  gone.traits.name = "gone";
  gone.unavailable = "it was lent to somebody";
  r.add(gone);
  return r;
}

study_plan planned(const json& parts) {
  return parse_plan({{"schema", plan_schema},
                     {"study", "s"},
                     {"title", "t"},
                     {"defaults", {{"dx", 0.08}, {"M", 3}}},
                     {"parts", parts}},
                    2);
}

TEST(measurable, a_plan_that_lacks_nothing_stays_as_it_is) {
  const study_plan plan = planned({{{"name", "a"}, {"backend", "naive,symmetric"}}});
  const plan_here here = measurable(plan, lacking());
  EXPECT_TRUE(here.left_out.empty());
  EXPECT_EQ(plan_json(here.plan), plan_json(plan));
}

TEST(measurable, what_the_build_lacks_is_left_out_with_the_reason) {
  const registry all = lacking();
  const plan_here here =
      measurable(planned({{{"name", "a"}, {"backend", "naive,gone"}, {"precision", "double,quadruple"}},
                          {{"name", "b"}, {"backend", "symmetric"}},
                          {{"name", "c"}, {"dim", 4}},
                          {{"name", "d"}, {"backend", "gone"}}}),
                 all);
  ASSERT_EQ(here.plan.parts.size(), 2u);
  EXPECT_EQ(here.plan.parts[0].request.backends, texts{"naive"});
  EXPECT_EQ(here.plan.parts[0].request.precisions, texts{"double"});
  EXPECT_EQ(here.plan.parts[1].request.part, "b");
  ASSERT_EQ(here.left_out.size(), 3u);
  const texts& of_a = here.left_out.at("a");
  ASSERT_EQ(of_a.size(), 2u);
  EXPECT_EQ(of_a[0], "backend gone is unavailable: it was lent to somebody");
  EXPECT_TRUE(of_a[1].starts_with("precision quadruple is not in this build; configure with -DPAIRSUM_PRECISIONS=all"));
  EXPECT_TRUE(here.left_out.at("c").front().starts_with("dimension 4 is not in this build"));
}

TEST(measurable, words_that_nobody_knows_are_refused) {
  EXPECT_THROW(measurable(planned({{{"name", "a"}, {"backend", "naive,gnoe"}}}), lacking()), error);
  EXPECT_THROW(measurable(planned({{{"name", "a"}, {"precision", "half"}}}), lacking()), error);
  EXPECT_THROW(measurable(planned({{{"name", "a"}, {"case", "river"}}}), lacking()), error);
  EXPECT_THROW(measurable(planned({{{"name", "a"}, {"M", 77}}}), lacking()), error);
}

TEST(measurable, a_backend_without_what_is_asked_is_left_out_and_the_others_stay) {
  const plan_here here = measurable(planned({{{"name", "a"}, {"backend", "atomic_add,naive"}, {"isa", "best"}}}));
  if (isa_names().empty()) GTEST_SKIP() << "no vector units here";
  ASSERT_EQ(here.plan.parts.size(), 1u);
  EXPECT_EQ(here.plan.parts[0].request.backends, texts{"naive"});
  EXPECT_TRUE(here.left_out.at("a").front().starts_with("backend atomic_add is unavailable with isa best"));
}

TEST(measurable, a_dry_run_says_what_is_left_out_and_why) {
  const registry all = lacking();
  study_plan plan = planned({{{"name", "both"}, {"backend", "naive"}, {"precision", "double,quadruple"}},
                             {{"name", "whole"}, {"backend", "naive"}},
                             {{"name", "none"}, {"dim", 4}}});
  const std::string text = dry_run(plan, all);
  const auto says = [&](const std::string& line) { return text.find(line) != text.npos; };
  EXPECT_TRUE(says("part both: 1 point, 6 rounds;")) << text;
  EXPECT_TRUE(says("  left out: precision quadruple is not in this build; configure with")) << text;
  EXPECT_TRUE(says("part none: nothing of it can be measured here\n")) << text;
  EXPECT_TRUE(says("2 of 3 parts cannot be measured as they are by this build on this machine\n")) << text;
  EXPECT_TRUE(says("for the least rounds of every part")) << text;
  plan.parts.erase(plan.parts.begin(), plan.parts.begin() + 2);
  EXPECT_EQ(dry_run(plan, all).find("for the least rounds"), std::string::npos);
  EXPECT_EQ(dry_run(planned({{{"name", "whole"}, {"backend", "naive"}}}), all).find("left out"), std::string::npos);
}

}  // namespace
}  // namespace pairsum::harness

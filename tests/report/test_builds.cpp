#include <functional>

#include "tests/report/made_builds.hpp"

// Rows of several machines and builds.
namespace pairsum::harness {
namespace {

using synthetic::build;
using synthetic::by;

TEST_F(report, different_machines_and_builds_are_refused_unless_allowed) {
  write(talk());
  const std::vector<std::function<void(environment_row&)>> changes{
      [](environment_row& e) { e.host = "other"; },     [](environment_row& e) { e.cpu = "other"; },
      [](environment_row& e) { e.compiler = "other"; }, [](environment_row& e) { e.flags = "other"; },
      [](environment_row& e) { e.git = "other"; },      [](environment_row& e) { e.binding = "other"; },
      [](environment_row& e) { e.dirty = false; }};
  for (const auto& change : changes) {
    std::filesystem::remove(file("talk/second.jsonl"));
    environment_row e = example::environment();
    change(e);
    e.environment = "1111111111111111";
    synthetic::write_builds(file("talk/second.jsonl"), {e}, {by(e, {"naive", 6, 1, 7.0})}, 1);
    const std::string what = message_of([&] { make(); });
    EXPECT_CONTAINS(what, "the rows come from different machines or builds: ");
    EXPECT_CONTAINS(what, e.dirty ? "other" : "uncommitted changes");
    const json mixed = make(true);
    EXPECT_EQ(mixed["series"].size(), 2u);
    EXPECT_EQ(mixed["points"].size(), 10u);
    EXPECT_TRUE(mixed["compiler_comparison"].empty());
    EXPECT_TRUE(has_caveat(mixed, "naive M=6 threads=1 (dam_break, rest, dx 0.00594, lattice, double, ferrari09,"));
    EXPECT_TRUE(has_caveat(mixed, "rows of different machines or builds in one report"));
  }
}

TEST_F(report, another_environment_of_the_same_build_is_the_same_series) {
  write(talk());
  environment_row e = example::environment();
  e.environment = "1111111111111111";
  e.governor = "powersave";
  synthetic::write_builds(file("talk/second.jsonl"), {e}, {by(e, {"naive", 6, 1, 1.0})}, 1);
  const json summary = make();
  EXPECT_EQ(summary["series"].size(), 1u);
  EXPECT_EQ(only(summary["points"], {{"backend", "naive"}, {"M", 6}})["rounds"], 7);
  EXPECT_TRUE(has_caveat(summary, "different frequency governors"));
}

TEST_F(report, builds_measured_in_the_same_rounds_are_compared) {
  const environment_row gcc = build('1', "GNU 12.2.0"), clang = build('2', "Clang 14.0.6");
  synthetic::write_builds(rows_path(), {gcc, clang},
                          {by(gcc, {"naive", 6, 1, 1.0}), by(gcc, {"symmetric", 6, 1, 0.5}),
                           by(clang, {"naive", 6, 1, 0.8, 6, [](sample& s) { s.point.isa = "sse2"; }})});
  const json s = make();
  EXPECT_EQ(s["series"].size(), 2u);
  ASSERT_EQ(s["compiler_comparison"].size(), 1u);
  const json& e = s["compiler_comparison"][0];
  EXPECT_EQ(e["base_compiler"], "GNU 12.2.0, git abc1234");
  EXPECT_EQ(e["compiler"], "Clang 14.0.6, git abc1234");
  EXPECT_EQ(e["backend"], "naive");
  EXPECT_VALUE(e["base_time_s"], 1.05);
  EXPECT_VALUE(e["time_s"], 0.84);
  EXPECT_VALUE(e["ratio"], 1.25);
  EXPECT_EQ(e["verdict"], "faster");
  EXPECT_TRUE(has_caveat(s, "the builds differ, which is what is compared: compiler (Clang 14.0.6, GNU 12.2.0)"));
  EXPECT_CONTAINS(text_, "Builds: summation time of this one, Clang 14.0.6, git abc1234\nand of the base, GNU 12.2.0");
}

TEST_F(report, the_same_builds_measured_in_different_rounds_are_refused) {
  const environment_row gcc = build('1', "GNU 12.2.0"), clang = build('2', "Clang 14.0.6");
  synthetic::write_builds(file("talk/a.jsonl"), {gcc}, {by(gcc, {"naive", 6, 1, 1.0})});
  synthetic::write_builds(file("talk/b.jsonl"), {clang}, {by(clang, {"naive", 6, 1, 0.8})});
  EXPECT_CONTAINS(message_of([&] { make(); }), "different machines or builds: compiler (Clang 14.0.6, GNU 12.2.0)");
}

TEST_F(report, three_builds_in_a_round_are_compared_in_any_order) {
  const environment_row a = build('1', "A"), b = build('2', "B"), c = build('3', "C");
  {
    row_writer writer(rows_path());
    for (const environment_row& e : {a, b, c}) writer.write(e);
    for (const environment_row& e : {b, a, c}) write_sample(writer, synthetic::step(by(e, {"naive", 6, 1, 1.0}), 1, 1));
    writer.write(synthetic::closing_by(a, 1, 3));
    for (const environment_row& e : {c, b, a}) write_sample(writer, synthetic::step(by(e, {"naive", 6, 1, 1.0}), 2, 1));
    writer.write(synthetic::closing_by(a, 2, 3));
  }
  const json s = make();
  EXPECT_EQ(s["compiler_comparison"].size(), 2u);
}

TEST_F(report, studies_in_one_file_have_rounds_of_their_own) {
  const environment_row a = build('1', "A"), b = build('2', "B");
  {
    row_writer writer(rows_path());
    writer.write(a);
    writer.write(b);
    write_sample(writer, synthetic::step(by(a, {"naive", 6, 1, 1.0}), 1, 1));
    writer.write(synthetic::closing_by(a, 1, 1, "talk"));
    sample other = synthetic::step(by(b, {"naive", 6, 1, 1.0}), 1, 1);
    other.study = "other";
    write_sample(writer, other);
    writer.write(synthetic::closing_by(b, 1, 1, "other"));
  }
  EXPECT_CONTAINS(message_of([&] { make(); }), "different machines or builds: compiler (A, B)");
}

}  // namespace
}  // namespace pairsum::harness

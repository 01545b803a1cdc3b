#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "harness/run/level_columns.hpp"
#include "harness/run/results_table.hpp"

namespace pairsum::harness {
namespace {

point made_point(const std::string& backend) {
  point p;
  p.case_name = "dam_break";
  p.state = "rest";
  p.dx = 0.02;
  p.H = 0.04;
  p.n_fluid = 1000;
  p.n_boundary = 500;
  p.order = "lattice";
  p.precision = "double";
  p.interaction = "ferrari09";
  p.smoothing = "wendland_c2";
  p.integrator = "euler";
  p.dt = 1e-5;
  p.backend = backend;
  p.grid = "hashed_grid";
  p.M = 6;
  p.threads = 2;
  p.granularity = backend;  // each backend has its own
  p.isa = "scalar";
  return p;
}

/// Rounds whose step takes `step_s` times what the machine does to the round, and 1 % more in every other one.
std::vector<sample> measured(const point& p, double step_s, int rounds = 6, int first = 1,
                             const std::string& build = "b") {
  std::vector<sample> samples;
  for (int k = 0; k < rounds; ++k) {
    sample s;
    s.point = p;
    s.round = first + k;
    s.environment = build;
    const double disturbed = step_s * (1 + 0.2 * k) * (1 + 0.01 * (k % 2));
    s.phases = phases{};
    s.phases->total_s = disturbed;
    s.phases->sum_s = 0.5 * disturbed;
    samples.push_back(s);
  }
  return samples;
}

std::vector<sample> joined(std::initializer_list<std::vector<sample>> parts) {
  std::vector<sample> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string line_with(const std::string& text, const std::string& what) {
  for (const std::string& line : lines_of(text))
    if (line.find(what) != line.npos) return line;
  return "";
}

bool has(const std::string& text, const std::string& what) { return text.find(what) != text.npos; }

TEST(ranking, is_sorted_and_paired_over_rounds) {
  // A constant factor in every round: whatever the machine does to both cancels.
  const auto all = rank(joined({measured(made_point("slow"), 0.003), measured(made_point("fast"), 0.002)}));
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].size(), 2u);
  EXPECT_EQ(all[0][0].what.backend, "fast");
  const ranked& slow = all[0][1];
  EXPECT_NEAR(slow.ratio.value, 1.5, 1e-9);
  EXPECT_EQ(slow.ratio.pairs, 6u);
  ASSERT_TRUE(slow.ratio.bounds.has_value());
  EXPECT_NEAR(slow.ratio.bounds->low, 1.5, 1e-6);
  EXPECT_TRUE(slow.is_slower);
}

TEST(ranking, what_scatters_more_than_it_differs_is_not_slower) {
  std::vector<sample> noisy = measured(made_point("b"), 0.00201);
  for (std::size_t k = 0; k < noisy.size(); ++k) *noisy[k].phases->total_s *= k % 2 == 0 ? 1.1 : 0.92;
  const auto all = rank(joined({measured(made_point("a"), 0.002), noisy}));
  EXPECT_FALSE(all[0][1].is_slower);
  EXPECT_TRUE(all[0][1].ratio.bounds.has_value());
}

TEST(ranking, rounds_apart_make_no_pairs) {
  const auto all = rank(joined({measured(made_point("a"), 0.002), measured(made_point("b"), 0.004, 6, 100)}));
  EXPECT_EQ(all[0][1].ratio.pairs, 0u);
  EXPECT_NEAR(all[0][1].ratio.value, 2, 1e-9);
  EXPECT_FALSE(all[0][1].is_slower);
}

TEST(ranking, problems_are_apart_the_largest_first) {
  point small = made_point("a");
  small.dx = 0.04;
  small.n_fluid = 100;
  point other = made_point("a");
  other.state = "perturbed";
  const auto all = rank(joined({measured(small, 0.001), measured(made_point("a"), 0.002), measured(other, 0.003)}));
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2][0].what.dx, 0.04);
}

TEST(ranking, a_failed_point_has_no_rank) {
  sample wrong;
  wrong.point = made_point("wrong");
  wrong.error = "rate 3 is wrong";
  const auto all = rank(joined({{wrong}, measured(made_point("a"), 0.002)}));
  EXPECT_EQ(all[0][0].what.backend, "a");
  EXPECT_TRUE(has_intervals(all)) << "it needs none";
  EXPECT_TRUE(has(results_table(all), "wrong FAILED: rate 3 is wrong"));
}

TEST(ranking, a_point_that_lost_particles_has_no_rank) {
  std::vector<sample> emptied = measured(made_point("emptied"), 0.0001);
  for (sample& s : emptied) s.lost = 7;
  const auto all = rank(joined({emptied, measured(made_point("a"), 0.002), measured(made_point("b"), 0.004)}));
  EXPECT_EQ(all[0][0].what.backend, "a");
  EXPECT_EQ(all[0][2].what.backend, "emptied");
  const std::string text = results_table(all);
  EXPECT_TRUE(has(line_with(text, "emptied  "), "no answer")) << text;
  EXPECT_TRUE(has(text, "emptied lost 7 of 1000 fluid particles")) << text;
  EXPECT_TRUE(has(text, "\na ran 2.000 [2.000, 2.000] times as fast as b\n")) << text;
  const std::string none = results_table(rank(joined({emptied, emptied})));
  EXPECT_FALSE(has(none, "fastest")) << none;
}

TEST(results_table, has_a_column_for_what_differs_and_none_for_what_is_constant) {
  point mixed = made_point("a");
  mixed.precision = "mixed";
  const std::string text = results_table(rank(joined({measured(made_point("a"), 0.002), measured(mixed, 0.001)})));
  const std::string head = line_with(text, "backend");
  EXPECT_TRUE(has(head, "precision")) << text;
  for (const char* const constant : {"threads", "grid", "isa", "block", "granularity", "rounds", " M "})
    EXPECT_FALSE(has(head, constant)) << text;
  EXPECT_EQ(lines_of(text).front(),
            "hashed_grid, M 6, threads 2, scalar, a, rounds 6; medians of rounds, intervals of 95 %");
  EXPECT_TRUE(has(text,
                  "dam_break 3D, dx 0.02, rest, H = 2 dx, ferrari09, wendland_c2, euler, order lattice: "
                  "1000 fluid and 500 boundary particles"));
  EXPECT_TRUE(has(text, "a mixed ran 2.000 [2.000, 2.000] times as fast as a double\n")) << text;
}

TEST(results_table, what_each_backend_has_of_its_own_is_no_level) {
  const auto all = rank(joined({measured(made_point("a"), 0.002), measured(made_point("b"), 0.003)}));
  EXPECT_FALSE(has(line_with(results_table(all), "backend"), "granularity"));
  point chunk = made_point("a");
  chunk.granularity = "dynamic:8";
  const auto two = rank(joined({measured(made_point("a"), 0.002), measured(chunk, 0.003)}));
  EXPECT_TRUE(has(line_with(results_table(two), "backend"), "granularity"));
}

TEST(results_table, builds_that_are_compared_are_apart) {
  const auto samples =
      joined({measured(made_point("a"), 0.002, 6, 1, "one"), measured(made_point("a"), 0.003, 6, 1, "two")});
  environment_row one, two;
  one.environment = "one", two.environment = "two", one.compiler = "GNU 12", two.compiler = "Clang 14";
  const auto all = rank(samples, build_words({one, two}));
  EXPECT_TRUE(has(results_table(all), "a GNU 12 ran 1.500 [1.500, 1.500] times as fast as a Clang 14"));
  two.compiler = one.compiler;
  two.git = "abc";
  EXPECT_EQ(build_words({one, two}).at("two"), "abc");
  two.git = one.git;
  EXPECT_EQ(build_words({one, two}).at("two"), "two");
  EXPECT_EQ(rank(samples)[0].size(), 1u) << "of one build, resumed on another day";
}

TEST(results_table, says_what_is_not_decided_and_what_has_too_few_rounds) {
  std::vector<sample> noisy = measured(made_point("b"), 0.00201);
  for (std::size_t k = 0; k < noisy.size(); ++k) *noisy[k].phases->total_s *= k % 2 == 0 ? 1.1 : 0.92;
  const std::string alone = results_table(rank(joined({measured(made_point("a"), 0.002), noisy})));
  EXPECT_TRUE(has(alone, "nothing is decided: a had the shortest times, and cannot be told from b")) << alone;
  const std::string three =
      results_table(rank(joined({measured(made_point("a"), 0.002), noisy, measured(made_point("c"), 0.004)})));
  EXPECT_TRUE(has(three, "a ran 2.000 [2.000, 2.000] times as fast as c\nnot decided between it and b\n")) << three;
  const auto few = rank(joined({measured(made_point("a"), 0.002, 2), measured(made_point("b"), 0.004, 2)}));
  EXPECT_TRUE(has(line_with(results_table(few), "b  "), "too few rounds")) << results_table(few);
  EXPECT_TRUE(has(results_table(few), "nothing is decided: a ratio's interval needs 3 rounds that have both\n"));
  EXPECT_FALSE(has_intervals(few));
  EXPECT_FALSE(has_intervals(rank(measured(made_point("a"), 0.002, 5))));
  EXPECT_TRUE(has_intervals(rank(measured(made_point("a"), 0.002, 6))));
  EXPECT_FALSE(has(results_table(rank(measured(made_point("a"), 0.002))), "decided")) << "one point has nothing to say";
}

TEST(results_table, counts_what_it_does_not_show) {
  std::vector<sample> all;
  for (int k = 0; k < 40; ++k)
    for (const sample& s : measured(made_point("backend_" + std::to_string(100 + k)), 0.001 * (k + 1)))
      all.push_back(s);
  const std::string text = results_table(rank(all));
  EXPECT_TRUE(has(text, "\n10 more in the report\n")) << text;
  EXPECT_TRUE(has(text, "backend_129 ")) << text;
  EXPECT_FALSE(has(text, "backend_130 ")) << text;
  EXPECT_LT(std::ranges::max(lines_of(text), {}, &std::string::size).size(), 130u) << text;
}

TEST(results_table, of_many_problems_shows_the_largest) {
  std::vector<sample> all;
  for (int k = 1; k <= 20; ++k)
    for (const char* const backend : {"a", "b", "c", "d"}) {
      point p = made_point(backend);
      p.dx = 0.001 * k;
      p.n_fluid = static_cast<std::uint64_t>(10000 / k);
      for (const sample& s : measured(p, 0.001)) all.push_back(s);
    }
  const std::string text = results_table(rank(all));
  EXPECT_TRUE(has(text, "\n50 more in the report\n")) << text;
  EXPECT_TRUE(has(text, "dx 0.01,") && !has(text, "dx 0.011,")) << text;
}

TEST(results_table, of_one_point_has_no_ratio) {
  const std::string text = results_table(rank(measured(made_point("a"), 0.002)));
  EXPECT_TRUE(has(text, "step ms") && has(text, "sum ms")) << text;
  for (const char* const word : {"ratio", "it is", "fastest"}) EXPECT_FALSE(has(text, word)) << text;
}

TEST(results_table, has_colours_only_if_it_shall) {
  const auto all = rank(joined({measured(made_point("a"), 0.002), measured(made_point("b"), 0.004)}));
  EXPECT_EQ(results_table(all).find('\x1b'), std::string::npos);
  std::string coloured = results_table(all, true);
  EXPECT_TRUE(has(coloured, "\x1b[32ma\x1b[0m")) << coloured;
  for (const char* const code : {"\x1b[1m", "\x1b[32m", "\x1b[33m", "\x1b[0m"})
    for (std::size_t at; (at = coloured.find(code)) != coloured.npos;) coloured.erase(at, std::string(code).size());
  EXPECT_EQ(coloured, results_table(all)) << "colours take no columns";
}

TEST(disturbance, is_of_others_and_of_void_rounds) {
  std::vector<round_row> rounds(4);
  EXPECT_EQ(disturbance_text(rounds, 0), "");
  rounds[0].others_share = 0.05;
  EXPECT_EQ(disturbance_text(rounds, 0), "");
  rounds[1].others_share = 0.051;
  EXPECT_TRUE(has(disturbance_text(rounds, 0), "in 1 of 4 rounds other processes used more than 5 % of the machine"));
  EXPECT_EQ(disturbance_text({}, 1), "1 round is void, cut before its end");
  EXPECT_TRUE(has(disturbance_text(rounds, 2), "; 2 rounds are void"));
}

}  // namespace
}  // namespace pairsum::harness

#include "tests/report/report_fixture.hpp"

// Which differences count as resolved.
namespace pairsum::harness {
namespace {

/// Pairs naive / symmetric at so many M, each with log ratios 0.25, 0.3, 0.35 over three rounds: Student's t is
/// 0.3 / (0.05 / sqrt(3)) with 2 degrees of freedom, so p = 1 - t / sqrt(2 + t^2) = 0.00913.
std::vector<made_point> pairs(int count, double sign = 1) {
  std::vector<made_point> points;
  for (int k = 0; k < count; ++k) {
    points.push_back({"naive", 8 + k, 1, 1.0, 3});
    points.push_back({"symmetric", 8 + k, 1, 1.0, 3, synthetic::scattered({-sign * 0.25, -sign * 0.3, -sign * 0.35})});
  }
  return points;
}

TEST_F(report, one_difference_is_resolved_by_its_own_p_value) {
  const json e = summary_of(pairs(1), 3)["algorithm_speedup"].at(0);
  EXPECT_VALUE(e["speedup"], std::exp(0.3));
  const double reach = 4.302652729911275 * 0.05 / std::sqrt(3.0);  // the 97.5 % quantile of t with 2
  EXPECT_VALUE(e["low"], std::exp(0.3 - reach));
  EXPECT_VALUE(e["high"], std::exp(0.3 + reach));
  EXPECT_EQ(e["verdict"], "faster");
}

TEST_F(report, a_slower_one_is_called_slower) {
  EXPECT_EQ(summary_of(pairs(1, -1), 3)["algorithm_speedup"].at(0)["verdict"], "slower");
}

TEST_F(report, differences_of_a_table_are_judged_together) {
  const json five = summary_of(pairs(5), 3)["algorithm_speedup"];  // 5 p = 0.0457
  EXPECT_EQ(five.size(), 5u);
  for (const json& e : five) EXPECT_EQ(e["verdict"], "faster");
}

TEST_F(report, more_comparisons_need_smaller_p_values) {
  const json six = summary_of(pairs(6), 3)["algorithm_speedup"];  // 6 p = 0.0548
  EXPECT_EQ(six.size(), 6u);
  for (const json& e : six) EXPECT_EQ(e["verdict"], "not resolved");
}

TEST_F(report, two_rounds_resolve_nothing) {
  const json e = summary_of(pairs(1), 2)["algorithm_speedup"].at(0);
  EXPECT_VALUE(e["speedup"], std::exp(0.275));
  EXPECT_TRUE(e["low"].is_null());
  EXPECT_TRUE(e["confidence"].is_null());
  EXPECT_EQ(e["verdict"], "not resolved");
  EXPECT_CONTAINS(text_, "no interval");
}

}  // namespace
}  // namespace pairsum::harness

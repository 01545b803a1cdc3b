#include "tests/report/report_fixture.hpp"

// What the report says of backends whose behaviour is known.
namespace pairsum::harness {
namespace {

const std::vector<double> none{0.01, -0.01, 0.01, -0.01, 0.01, -0.01};

made_point copy(const std::string& backend, double sum_s) {
  return {backend, 7, 2, sum_s, 6, synthetic::scattered(none)};
}

void refused(sample& s) {
  s.error = "particle 3 is off";
  s.phases.reset();
}

TEST_F(report, known_ratios_hold) {
  const json s = summary_of({{"symmetric_omp", 7, 2, 1.0},
                             copy("again_symmetric_omp", 1.0),
                             copy("slowed_5_symmetric_omp", 1.05),
                             copy("slowed_20_symmetric_omp", 1.2),
                             {"corrupt_symmetric_omp", 7, 2, 1.0, 6, refused}});
  ASSERT_EQ(s["self_test"].size(), 4u);
  for (const json& e : s["self_test"]) EXPECT_TRUE(e["holds"].get<bool>()) << e;
  const json same = only(s["self_test"], {{"what", "A/A"}});
  EXPECT_VALUE(same["ratio"], 1.0);
  EXPECT_LT(same["low"], 1.0);
  EXPECT_GT(same["high"], 1.0);
  EXPECT_VALUE(same["confidence"], 1 - 0.05 / 3) << "over all three ratios together";
  EXPECT_EQ(same["base_backend"], "symmetric_omp");
  const json slowed = only(s["self_test"], {{"what", "slowed 5 %"}});
  EXPECT_VALUE(slowed["ratio"], 1.05);
  EXPECT_VALUE(slowed["expected"], 1.05);
  EXPECT_CONTAINS(slowed["text"].get<std::string>(), "inside the interval, told from its base");
  const json corrupt = only(s["self_test"], {{"what", "corrupt"}});
  EXPECT_TRUE(corrupt["ratio"].is_null());
  EXPECT_TRUE(corrupt["expected"].is_null());
  EXPECT_EQ(corrupt["text"], "refused, as it must be: particle 3 is off");
  EXPECT_FALSE(has_caveat(s, "does not hold"));
}

TEST_F(report, a_wrong_ratio_does_not_hold) {
  const json s = summary_of({{"naive_omp", 7, 2, 1.0}, copy("slowed_20_naive_omp", 1.05)});
  ASSERT_EQ(s["self_test"].size(), 1u);
  EXPECT_FALSE(s["self_test"][0]["holds"].get<bool>());
  EXPECT_TRUE(has_caveat(s, "self-test slowed_20_naive_omp M=7 threads=2 does not hold: 1.0500 ["));
  EXPECT_CONTAINS(text_, "  NO\n");
}

TEST_F(report, a_copy_that_is_slower_does_not_hold) {
  const json s = summary_of({{"naive_omp", 7, 2, 1.0}, copy("again_naive_omp", 1.05)});
  EXPECT_FALSE(s["self_test"][0]["holds"].get<bool>());
}

TEST_F(report, a_corrupt_backend_with_a_time_does_not_hold) {
  const json s = summary_of({{"naive_omp", 7, 2, 1.0}, copy("corrupt_naive_omp", 1.0)});
  ASSERT_EQ(s["self_test"].size(), 1u);
  EXPECT_FALSE(s["self_test"][0]["holds"].get<bool>());
  EXPECT_EQ(s["self_test"][0]["text"], "it got a time, although it is wrong");
}

TEST_F(report, a_copy_that_fails_or_has_no_base_does_not_hold) {
  const json s = summary_of(
      {{"naive_omp", 7, 1, 1.0}, copy("again_naive_omp", 1.0), {"slowed_5_naive_omp", 7, 2, 1.0, 6, refused}});
  const json alone = only(s["self_test"], {{"backend", "again_naive_omp"}});
  EXPECT_FALSE(alone["holds"].get<bool>());
  EXPECT_EQ(alone["text"], "its base was not measured");
  const json failed = only(s["self_test"], {{"backend", "slowed_5_naive_omp"}});
  EXPECT_FALSE(failed["holds"].get<bool>());
  EXPECT_EQ(failed["text"], "failed its verification: particle 3 is off");
}

TEST_F(report, a_study_without_them_has_no_self_test) { EXPECT_TRUE(summary_of(talk())["self_test"].empty()); }

}  // namespace
}  // namespace pairsum::harness

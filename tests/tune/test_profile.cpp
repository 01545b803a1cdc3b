#include <gtest/gtest.h>

#include <pairsum/core/error.hpp>
#include <pairsum/sum/profile.hpp>

namespace pairsum {
namespace {

std::string refusal(const std::string& words) {
  try {
    parse_profile(words);
  } catch (const error& e) {
    return e.what();
  }
  return "";
}

TEST(profile, words_become_a_setup_and_leave_the_world_alone) {
  const profile p =
      parse_profile("backend=tiles_omp grid=compact_grid isa=avx2 block=slab:4  precision=float threads=3");
  setup s;
  s.constants.H = 0.25;
  s.M = 9;
  s.interaction = "count";
  const setup made = p.in(s);
  EXPECT_EQ(made.backend, "tiles_omp");
  EXPECT_EQ(made.grid, "compact_grid");
  EXPECT_EQ(made.isa, "avx2");
  EXPECT_EQ(made.block, "slab:4");
  EXPECT_EQ(made.precision, "float");
  EXPECT_EQ(made.interaction, "count");
  EXPECT_EQ(made.constants.H, 0.25);
  EXPECT_EQ(p.threads, 3);
  EXPECT_EQ(p.granularity, "default");
  EXPECT_EQ(parse_profile("backend=naive M=5 threads=1").in(s).M, 5);
}

TEST(profile, what_is_wrong_is_said) {
  EXPECT_EQ(refusal(""), "a profile lacks backend");
  EXPECT_EQ(refusal("backend=naive"), "a profile lacks threads");
  EXPECT_EQ(refusal("backend= threads=1"), "a profile's backend has no value");
  EXPECT_EQ(refusal("backend threads=1"), "a profile's backend has no value");
  EXPECT_EQ(refusal("backend=naive threads=1 threads=2"), "a profile has threads twice");
  EXPECT_NE(refusal("backend=naive threads=1 bakcend=x").find("unknown key of a profile \"bakcend\""),
            std::string::npos);
  for (const char* bad : {"0", "-1", "x", "2x", "99999999999"})
    EXPECT_NE(refusal(std::string("backend=naive threads=") + bad).find("whole number from 1"), std::string::npos)
        << bad;
}

}  // namespace
}  // namespace pairsum

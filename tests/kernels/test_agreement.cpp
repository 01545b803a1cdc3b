#include <gtest/gtest.h>

#include <limits>

#include <pairsum/core/workers.hpp>
#include <pairsum/sum/agreement.hpp>
#include "scene.hpp"

namespace pairsum {
namespace {

const double infinity = std::numeric_limits<double>::infinity();

// One rate of particles 0 and 2, of which the reference evaluated both; particle 1 is not asked for.
expectation expected(double bound = 0.5) {
  expectation e;
  e.names = {"a"};
  e.ids = {0, 2};
  e.value = {{1, 2}};
  e.bound = {{bound, bound}};
  e.magnitude = {{1, 2}};
  return e;
}

double share(std::vector<double> rates, double bound = 0.5) {
  return share_of_bound({{"a"}, {std::move(rates)}}, expected(bound));
}

TEST(agreement, is_the_largest_error_in_units_of_its_bound) {
  EXPECT_EQ(share({1, 99, 2}), 0);
  EXPECT_EQ(share({1.25, 99, 2}), 0.5);
  EXPECT_EQ(share({0.75, 99, 2.5}), 1);
  EXPECT_EQ(share({1, 99, 2}, 0), 0);
}

TEST(agreement, rejects) {
  EXPECT_EQ(share({1, 99, 3}), 2);
  EXPECT_EQ(share({1, 99, 2.25}, 0), infinity);
  EXPECT_EQ(share({std::numeric_limits<double>::quiet_NaN(), 99, 2}), infinity);
  EXPECT_EQ(share({infinity, 99, 2}), infinity);
  EXPECT_EQ(share({1, 99, 2}, infinity), infinity);
  EXPECT_EQ(share({1, 99, 2}, std::numeric_limits<double>::quiet_NaN()), infinity);
  EXPECT_EQ(share_of_bound({{"b"}, {{1, 99, 2}}}, expected()), infinity);
}

TEST(workers, give_every_index_to_one_call) {
  for (const runtime kind : {runtime::serial, runtime::omp, runtime::tbb}) {
    const workers two(kind, 2);
    EXPECT_EQ(two.get().threads(), 2);
    EXPECT_EQ(two.get().kind(), kind == runtime::tbb ? runtime::tbb : runtime::omp);
    std::vector<int> calls(100);
    two.get().for_each(calls.size(), [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(100, 1)) << name_of(kind);
  }
}

TEST(workers, need_a_thread) {
  for (const int bad : {0, -1})
    EXPECT_TRUE(test_kit::says(test_kit::error_of([&] { workers(runtime::omp, bad); }), {"at least 1 thread"}));
}

}  // namespace
}  // namespace pairsum

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/ranks/placement.hpp"

namespace pairsum::harness {
namespace {

using firsts = std::vector<std::size_t>;

TEST(placement, ranks_that_may_run_on_the_same_units_share_them_out) {
  const rank_seat whole{"node", {0, 2, 1, 3}, 4};
  const placement p = place({whole, whole}, 2);
  EXPECT_EQ(p.first, (firsts{0, 2}));
  EXPECT_EQ(p.why_untimed, "");
  EXPECT_EQ(units_text(whole, p.first[0], 2), "0,2");
  EXPECT_EQ(units_text(whole, p.first[1], 2), "1,3");
}

TEST(placement, ranks_on_several_hosts_count_on_their_own) {
  const placement p = place({{"a", {0, 1}, 2}, {"b", {0, 1}, 2}, {"a", {0, 1}, 2}, {"b", {0, 1}, 2}}, 1);
  EXPECT_EQ(p.first, (firsts{0, 0, 1, 1}));
  EXPECT_EQ(p.why_untimed, "");
}

TEST(placement, ranks_with_units_of_their_own_keep_them) {
  const placement p = place({{"node", {0, 1}, 2}, {"node", {2, 3}, 2}}, 2);
  EXPECT_EQ(p.first, (firsts{0, 0}));
  EXPECT_EQ(p.why_untimed, "");
}

TEST(placement, more_threads_than_cores_get_no_times) {
  const rank_seat whole{"node", {0, 1}, 2};
  EXPECT_EQ(place({whole, whole, whole}, 1).why_untimed, "3 ranks with 1 thread each on 2 cores of node");
  EXPECT_EQ(place({whole}, 4).why_untimed,
            "rank 0 has 4 threads on 2 cores of node: mpirun --bind-to none, or srun "
            "--cpus-per-task=4 --cpu-bind=cores, gives each its own");
  const rank_seat limited{"node", {0, 1, 2, 3}, 2};  // by a control group
  EXPECT_EQ(place({limited, limited}, 2).why_untimed, "2 ranks with 2 threads each on 2 cores of node");
}

TEST(placement, ranks_bound_to_one_core_are_told_what_cures_it) {
  const std::string bound = place({{"node", {0}, 1}, {"node", {1}, 1}}, 2).why_untimed;
  EXPECT_NE(bound.find("rank 0 has 2 threads on 1 core of node: mpirun --bind-to none"), std::string::npos) << bound;
  const std::string one_core = place({{"node", {0, 1}, 2}, {"node", {1, 2}, 2}}, 1).why_untimed;
  EXPECT_NE(one_core.find("share cores, others do not: mpirun --bind-to none"), std::string::npos) << one_core;
}

TEST(placement, without_bound_threads_cores_are_counted) {
  EXPECT_EQ(place({{"node", {}, 2}, {"node", {}, 2}}, 1).why_untimed, "");
  EXPECT_EQ(place({{"node", {}, 2}, {"node", {}, 2}}, 2).why_untimed, "2 ranks with 2 threads each on 2 cores of node");
  EXPECT_EQ(units_text({"node", {}, 2}, 0, 2), "any");
}

}  // namespace
}  // namespace pairsum::harness

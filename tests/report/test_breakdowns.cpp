#include "harness/report/strategies.hpp"
#include "tests/report/report_fixture.hpp"

// How strategies fare from one world to another, and what counts as breaking down.
namespace pairsum::harness {
namespace {

/// A world of three backends on 2 threads in which the symmetric one takes so long.
std::vector<made_point> world(double symmetric_s, const std::function<void(sample&)>& change) {
  const auto whole = [change](sample& s) {
    s.phases->reduce_s = 0;
    change(s);
  };
  return {{"naive_omp", 6, 2, 1.0, 6, whole},
          {"symmetric_omp", 6, 2, symmetric_s, 6, whole},
          {"tiles_omp", 6, 2, 0.3, 6, whole}};
}

std::vector<made_point> both(std::vector<made_point> a, const std::vector<made_point>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const auto as_it_is = [](sample&) {};
const auto half_the_reach = [](sample& s) { s.point.H /= 2; };

TEST_F(report, a_strategy_that_stands_worse_in_a_sparse_world_is_found) {
  const json s = summary_of(both(world(0.5, as_it_is), world(1.25, half_the_reach)));
  ASSERT_EQ(s["strategy_shifts"].size(), 2u) << "of the sparse world alone, and not of the base";
  const json e = only(s["strategy_shifts"], {{"backend", "symmetric_omp"}});
  EXPECT_EQ(e["what"], "sparsity");
  EXPECT_EQ(e["world"], "dam_break 2D, H = 1 dx");
  EXPECT_EQ(e["base_world"], "dam_break 2D");
  EXPECT_VALUE(e["ratio"], 0.4);
  EXPECT_EQ(e["verdict"], "slower");
  EXPECT_EQ(e["rank"], 3);
  EXPECT_EQ(e["base_rank"], 2);
  EXPECT_EQ(only(s["strategy_shifts"], {{"backend", "tiles_omp"}})["verdict"], "not resolved") << "as it was";
  const json own = only(s["strategies"], {{"backend", "symmetric_omp"}});
  EXPECT_CONTAINS(own["breaks_down"].get<std::string>(),
                  "2.50 [2.50, 2.50] times as slow as in dam_break 2D; rank 3 of 3");
  EXPECT_TRUE(only(s["strategies"], {{"backend", "tiles_omp"}})["breaks_down"].is_null());
  EXPECT_CONTAINS(text_, "- symmetric_omp: dam_break 2D, H = 1 dx: against naive_omp");
}

TEST_F(report, a_plane_world_is_compared_with_that_in_space_and_a_case_with_the_dam_break) {
  const auto space = [](sample& s) { s.point.dim = 3; };
  const auto random = [](sample& s) { s.point.case_name = "random_clustered"; };
  const json s = summary_of(both(both(world(0.5, as_it_is), world(0.25, space)), world(0.75, random)));
  const json plane = only(s["strategy_shifts"], {{"backend", "symmetric_omp"}, {"what", "dimension"}});
  EXPECT_VALUE(plane["ratio"], 0.5);
  EXPECT_EQ(plane["base_world"], "dam_break 3D");
  const json clustered = only(s["strategy_shifts"], {{"backend", "symmetric_omp"}, {"what", "case"}});
  EXPECT_VALUE(clustered["ratio"], 2.0 / 3);
  EXPECT_EQ(clustered["base_world"], "dam_break 2D");
}

TEST_F(report, worlds_that_differ_in_more_than_one_respect_are_not_compared) {
  const auto other = [](sample& s) {
    s.point.H /= 2;
    s.point.precision = "float";
  };
  EXPECT_TRUE(summary_of(both(world(0.5, as_it_is), world(1.25, other)))["strategy_shifts"].empty());
}

TEST_F(report, scatter_that_is_as_wide_as_the_shift_resolves_nothing) {
  const auto noisy = synthetic::scattered({0.5, -0.7, 0.9, -0.4, 0.6, -0.8});
  auto points = both(world(0.5, as_it_is), world(0.65, half_the_reach));
  points[4].change = [noisy](sample& s) {
    s.phases->reduce_s = 0;
    s.point.H /= 2;
    noisy(s);
  };
  const json s = summary_of(points);
  EXPECT_EQ(only(s["strategy_shifts"], {{"backend", "symmetric_omp"}})["verdict"], "not resolved");
  EXPECT_TRUE(only(s["strategies"], {{"backend", "symmetric_omp"}})["breaks_down"].is_null());
}

json estimate(double value, double low, double high) { return {{"value", value}, {"low", low}, {"high", high}}; }

/// Tables of one backend whose ladder has one entry.
json tables(const json& changed) {
  json e{{"backend", "own"},       {"world", "w"},          {"threads", 8},
         {"over_serial", nullptr}, {"efficiency", nullptr}, {"extra_bytes_per_particle", nullptr}};
  e.update(changed);
  return {{"strategy_ladder", {e}}, {"strategy_shifts", json::array()}};
}

TEST(breakdown, is_said_where_the_interval_lies_beyond_the_limit) {
  const auto found = [](const json& changed) { return breakdowns(tables(changed), "own"); };
  EXPECT_TRUE(found(json::object()).empty());
  EXPECT_EQ(found({{"efficiency", estimate(0.6, 0.5, 0.7)}}),
            std::vector<std::string>{"8 threads: efficiency 0.60 [0.50, 0.70] (w)"});
  EXPECT_EQ(found({{"over_serial", estimate(2, 1.6, 2.5)}}),
            std::vector<std::string>{"1 thread: 2.00 [1.60, 2.50] times the serial sweep (w)"});
  EXPECT_EQ(found({{"extra_bytes_per_particle", 640.0}}),
            std::vector<std::string>{"memory: 640 bytes a particle more than the leanest, on 8 threads (w)"});
}

TEST(breakdown, is_not_said_where_the_interval_reaches_the_limit_or_is_not_known) {
  for (const json& changed :
       {json{{"efficiency", estimate(0.6, 0.4, 0.8)}}, json{{"over_serial", estimate(2, 1.4, 2.8)}},
        json{{"efficiency", {{"value", 0.2}, {"low", nullptr}, {"high", nullptr}}}},
        json{{"extra_bytes_per_particle", 99.0}},
        json{{"backend", "another"}, {"efficiency", estimate(0.1, 0.1, 0.1)}}})
    EXPECT_TRUE(breakdowns(tables(changed), "own").empty()) << changed;
}

}  // namespace
}  // namespace pairsum::harness

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include <pairsum/core/error.hpp>
#include <pairsum/core/isa.hpp>
#include "harness/plan/plan.hpp"
#include "harness/plan/variants.hpp"

namespace pairsum::harness {
namespace {

run_request request() {
  run_request r;
  r.backends = {"naive", "naive_omp", "symmetric_tbb"};
  r.M = {6, 7};
  r.threads = {1, 2, 4};
  return r;
}

run_request request_with(run_request r, std::vector<std::string> backends) {
  r.backends = std::move(backends);
  return r;
}

TEST(plan, crosses_the_lists_and_runs_serial_backends_once_per_M) {
  const auto worlds = expand(request());
  ASSERT_EQ(worlds.size(), 1u);
  const auto& points = worlds.front();
  EXPECT_EQ(points.size(), 2u * (1 + 3 + 3));
  EXPECT_EQ(std::ranges::count(points, "naive", &point::backend), 2);
  for (const point& p : points) {
    EXPECT_TRUE(p.backend != "naive" || p.threads == 1);
  }
}

TEST(plan, ranks_are_crossed_with_threads_and_cuts) {
  run_request r;
  r.backends = {"naive", "naive_omp", "symmetric_omp"};
  r.M = {6};
  r.threads = {};
  r.shared_threads = {4};
  r.ranks = {1, 2, 8};
  r.cuts = {"twice", "once"};
  const auto points = expand(r).front();
  const auto words = [&](const std::string& backend) {
    std::vector<std::string> found;
    for (const point& p : points)
      if (p.backend == backend)
        found.push_back(std::to_string(p.ranks) + "x" + std::to_string(p.threads) + " " + p.cut);
    return found;
  };
  using list = std::vector<std::string>;
  EXPECT_EQ(words("symmetric_omp"), (list{"1x4 none", "2x2 twice", "2x2 once", "8x1 twice", "8x1 once"}));
  EXPECT_EQ(words("naive_omp"), (list{"1x4 none", "2x2 twice", "8x1 twice"})) << "it has nothing to send back";
  EXPECT_EQ(words("naive"), (list{"1x1 none", "2x1 twice", "8x1 twice"}));
}

TEST(plan, one_world_per_dx_and_state) {
  run_request r = request();
  r.dx = {0.02, 0.03};
  r.states = {"rest", "perturbed"};
  EXPECT_EQ(expand(r).size(), 4u);
}

TEST(plan, granularities_are_those_of_the_backend_and_serial_ones_have_none) {
  run_request r;
  r.backends = {"naive", "symmetric_omp"};
  r.M = {6};
  r.threads = {2};
  r.granularities = {"default", "dynamic:32", "static:0"};
  EXPECT_THROW(check_request(request_with(r, {"naive_tbb"})), error);
  const auto points = expand(r).front();
  ASSERT_EQ(points.size(), 3u) << "the default is dynamic:32, which is there once";
  EXPECT_EQ(points[0].granularity, "none");
  EXPECT_EQ(points[1].granularity, "dynamic:32");
  EXPECT_EQ(points[2].granularity, "static:0");
}

TEST(plan, a_grid_that_takes_no_M_is_there_once) {
  run_request r;
  r.grids = {"hashed_grid", "compact_grid"};
  r.backends = {"symmetric_omp"};
  r.M = {6, 7};
  const auto points = expand(r).front();
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0].grid + std::to_string(points[0].M), "hashed_grid6");
  EXPECT_EQ(points[1].grid + std::to_string(points[1].M), "hashed_grid7");
  EXPECT_EQ(points[2].grid + std::to_string(points[2].M), "compact_grid0");
}

TEST(plan, isa_varies_for_every_backend_and_block_for_those_who_have_them) {
  run_request r;
  r.backends = {"naive_omp", "tiles_omp"};
  r.M = {6};
  r.isas = {"default", "scalar", "best"};
  r.blocks = {"auto", "slab:4"};
  EXPECT_NO_THROW(check_request(r));
  const std::ptrdiff_t isas = isa_names().empty() ? 1 : 2;  // best is what a backend does by default, or scalar is
  const auto points = expand(r).front();
  const auto of = [&](const char* backend) { return std::ranges::count(points, backend, &point::backend); };
  EXPECT_EQ(of("naive_omp"), isas);
  EXPECT_EQ(of("tiles_omp"), 2 * isas);
  EXPECT_EQ(points.front().isa, "scalar") << "naive_omp's default";
  const auto sets = isa_names();
  for (const point& p : points) {
    EXPECT_TRUE(p.isa == "scalar" || std::ranges::find(sets, p.isa) != sets.end()) << p.isa;
    EXPECT_EQ(p.block == "none", p.backend != "tiles_omp") << p.block;
  }
}

TEST(plan, what_cannot_be_had_on_vector_units_is_left_out_or_refused_with_the_reason) {
  if (isa_names().empty()) GTEST_SKIP() << "no set of this build runs on this machine";
  const auto refusal = [](const std::vector<std::string>& backends) -> std::string {
    run_request r;
    r.backends = backends;
    r.M = {6};
    r.isas = {"best"};
    try {
      check_request(r);
    } catch (const error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(refusal({"atomic_add"}).find("cannot add atomically"), std::string::npos) << refusal({"atomic_add"});
  EXPECT_NE(refusal({"naive_omp", "atomic_add"}).find("cannot add atomically"), std::string::npos);
  EXPECT_EQ(refusal({"naive_omp"}), "");
  EXPECT_EQ(refusal(available_backends()), "") << "nobody asked for it by name";
}

TEST(plan, order_is_a_permutation_that_seed_round_and_repetition_decide) {
  auto order = shuffled_order(50, 7, 1, 1);
  EXPECT_EQ(order, shuffled_order(50, 7, 1, 1));
  EXPECT_NE(order, shuffled_order(50, 7, 1, 2));
  EXPECT_NE(order, shuffled_order(50, 7, 2, 1));
  EXPECT_NE(shuffled_order(50, 7, 1, 2), shuffled_order(50, 7, 2, 1));
  EXPECT_NE(order, shuffled_order(50, 8, 1, 1));
  std::vector<std::size_t> all(50);
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_NE(order, all);
  std::ranges::sort(order);
  EXPECT_EQ(order, all);
}

TEST(plan, every_slot_is_reached_by_every_point) {
  for (const bool over_rounds : {true, false}) {
    std::vector<std::vector<int>> at(4, std::vector<int>(4, 0));
    for (int k = 1; k <= 400; ++k) {
      const auto order = over_rounds ? shuffled_order(4, 1, k, 1) : shuffled_order(4, 1, 1, k);
      for (std::size_t slot = 0; slot < 4; ++slot) ++at[order[slot]][slot];
    }
    for (const auto& row : at)
      for (const int n : row) EXPECT_GT(n, 50);  // 100 expected, standard deviation 8.7
  }
}

template <class Change>
void expect_refused(Change change, const std::string& says) {
  run_request r = request();
  change(r);
  try {
    check_request(r);
    ADD_FAILURE() << "accepted, should say: " << says;
  } catch (const error& e) {
    EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

TEST(plan, refuses_what_makes_no_sense_in_one_line) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(check_request(request()));
  expect_refused([](auto& r) { r.backends = {"nope"}; }, "valid: naive");
  expect_refused([](auto& r) { r.case_name = "nope"; }, "valid: dam_break");
  expect_refused([](auto& r) { r.states = {"nope"}; }, "valid: rest");
  expect_refused([](auto& r) { r.interactions = {"nope"}; }, "valid: ferrari09");
  expect_refused([](auto& r) { r.smoothings = {"nope"}; }, "valid: wendland_c2");
  expect_refused([](auto& r) { r.precisions = {"nope"}; }, "valid: double");
  expect_refused([](auto& r) { r.integrators = {"nope"}; }, "valid: euler");
  expect_refused([](auto& r) { r.grids = {"nope"}; }, "valid: hashed_grid");
  expect_refused([](auto& r) { r.isas = {"nope"}; }, "valid: ");
  for (const char* bad : {"nope", "slab", "slab:", "slab:0", "slab:x", "slab:4x", "ball:4", "slab:99999999999"})
    expect_refused([&](auto& r) { r.blocks = {"auto", bad}; }, "block must be auto, slab:N");
  expect_refused([](auto& r) { r.orders = {"nope"}; }, "valid: lattice");
  expect_refused([](auto& r) { r.outside = "nope"; }, "valid: error");
  expect_refused([](auto& r) { r.M = {0}; }, "between 2 and 10");
  expect_refused([](auto& r) { r.M = {1}; }, "one cell");
  expect_refused([](auto& r) { r.M = {40}; }, "between 2 and 10");
  expect_refused([](auto& r) { r.threads = {0}; }, "threads must be at least 1");
  expect_refused([](auto& r) { r.threads = {100000}; }, "at most 4096");
  for (const double bad : {-1.0, 0.0, nan, inf}) expect_refused([&](auto& r) { r.dx = {bad}; }, "dx must be");
  for (const double bad : {-1.0, nan, inf}) expect_refused([&](auto& r) { r.H = bad; }, "H must be");
  expect_refused([](auto& r) { r.dt = 0; }, "dt must be");
  expect_refused([](auto& r) { r.steps = 0; }, "steps must be");
  expect_refused([](auto& r) { r.repetitions = 0; }, "repetitions must be");
  expect_refused([](auto& r) { r.granularities = {"dynamic:0"}; }, "granularity");
  expect_refused([](auto& r) { r.study = "../x"; }, "study");
}

}  // namespace
}  // namespace pairsum::harness

#include <gtest/gtest.h>

#include <pairsum/core/error.hpp>
#include <pairsum/sum/profile.hpp>
#include "harness/tune/candidates.hpp"

namespace pairsum::harness {
namespace {

run_request request() {
  run_request r;
  r.backends = {"naive", "naive_omp", "symmetric_omp"};
  r.grids = {"hashed_grid", "compact_grid"};
  r.M = {6, 7};
  r.threads = {1, 2};
  return r;
}

TEST(candidates, first_of_every_backend_one_with_the_most_threads) {
  const auto points = candidates_of(request(), registry::instance());
  ASSERT_EQ(points.size(), 3u * 1 + 2 * 3 * 2);
  EXPECT_EQ(points[0].backend, "naive");
  EXPECT_EQ(points[1].backend, "naive_omp");
  EXPECT_EQ(points[2].backend, "symmetric_omp");
  EXPECT_EQ(points[3].backend, "naive");
  for (std::size_t k : {1, 2, 4, 5}) EXPECT_EQ(points[k].threads, 2) << k;
  EXPECT_EQ(points.back().threads, 1);
}

TEST(candidates, several_worlds_are_refused) {
  for (const auto& change : {+[](run_request& r) {
                               r.dx = {0.1, 0.2};
                             },
                             +[](run_request& r) { r.states.push_back("perturbed"); },
                             +[](run_request& r) { r.interactions.push_back("count"); }}) {
    run_request r = request();
    change(r);
    EXPECT_THROW(candidates_of(r, registry::instance()), error);
  }
}

TEST(candidates, words_and_options_name_them) {
  const registry& all = registry::instance();
  point p = candidates_of(request(), all)[2];
  EXPECT_EQ(options_of(p, all),
            "--backend symmetric_omp --grid hashed_grid --M 6 --precision double --threads 2 --granularity dynamic:32");
  p.grid = "compact_grid";
  p.M = 0;
  EXPECT_EQ(profile_words(p, all),
            "backend=symmetric_omp grid=compact_grid precision=double threads=2 granularity=dynamic:32");
  const profile read = parse_profile(profile_words(p, all));
  EXPECT_EQ(read.words.backend, "symmetric_omp");
  EXPECT_EQ(read.words.grid, "compact_grid");
  EXPECT_EQ(read.threads, 2);
  EXPECT_EQ(read.granularity, "dynamic:32");
}

TEST(candidates, the_case_is_said_as_far_as_it_is_not_the_usual) {
  run_request r = request();
  r.dx = {0.00594};
  EXPECT_EQ(case_options(r),
            "--case dam_break --dx 0.00594 --state rest --dim 3 --interaction ferrari09 --smoothing wendland_c2");
  r.H = 0.02;
  r.seed = 7;
  r.orders = {"morton"};
  const std::string text = case_options(r);
  EXPECT_NE(text.find(" --order morton --H 0.02 --seed 7"), text.npos) << text;
}

}  // namespace
}  // namespace pairsum::harness

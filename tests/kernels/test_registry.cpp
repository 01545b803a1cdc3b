#include <gtest/gtest.h>

#include <set>

#include "library_formulas.hpp"
#include "scene.hpp"

namespace pairsum {
namespace {

using namespace test_kit;

std::string refusal(const setup& s) {
  return error_of([&] { (void)registry::instance().make_summation(s); });
}

TEST(registry, lists_the_algorithms_of_the_talk_each_once) {
  const auto names = backend_names();
  const std::set<std::string> all(names.begin(), names.end());
  EXPECT_EQ(all.size(), names.size());
  for (const char* name : {"naive", "naive_omp", "naive_tbb", "pair_list", "sphysics_sweep", "ppm_stencil", "symmetric",
                           "symmetric_omp", "symmetric_tbb"})
    EXPECT_TRUE(all.contains(name)) << name;
}

/// What is wrong with how a backend says that it keeps threads apart; empty if nothing.
std::string fault_of_conflicts(const backend_traits& t) {
  const bool serial = t.conflicts == conflict_avoidance::serial, gather = t.conflicts == conflict_avoidance::gather;
  if (serial != (t.threads == runtime::serial)) return "is serial on several threads, or has one and is not";
  if (gather && t.symmetric) return "gathers, but computes each pair once";
  return "";
}

TEST(registry, every_backend_says_how_it_keeps_threads_apart) {
  for (const backend_entry& b : registry::instance().backends())
    EXPECT_EQ(fault_of_conflicts(b.traits), "") << b.traits.name;
}

TEST(registry, a_wrong_word_for_how_threads_are_kept_apart_is_found) {
  backend_traits t = registry::instance().find_backend("symmetric_omp").traits;
  EXPECT_EQ(fault_of_conflicts(t), "");
  for (const auto wrong : {conflict_avoidance::serial, conflict_avoidance::gather}) {
    t.conflicts = wrong;
    EXPECT_NE(fault_of_conflicts(t), "") << name_of(wrong);
  }
  t = registry::instance().find_backend("naive").traits;
  t.conflicts = conflict_avoidance::colours;
  EXPECT_NE(fault_of_conflicts(t), "");
  EXPECT_EQ(name_of(conflict_avoidance::tasks), "tasks");
}

TEST(registry, makes_every_combination_it_lists) {
  const registry& r = registry::instance();
  const setup world = make_scene("dam_break", 0.1, "rest").world;
  for (const std::string& backend : backend_names())
    for (const std::string& interaction : r.interactions()) {
      const auto sum = r.make_summation(with(world, backend, 3, interaction));
      ASSERT_NE(sum, nullptr);
      EXPECT_EQ(sum->traits().name, backend);
      EXPECT_FALSE(sum->traits().description.empty());
      EXPECT_NE(r.make_reference(with(world, backend, 3, interaction)), nullptr);
    }
}

TEST(registry, unknown_words_are_errors_that_list_the_valid_ones) {
  const setup good = make_scene("dam_break", 0.1, "rest").world;
  EXPECT_EQ(refusal(good), "");
  setup s = good;
  s.backend = "symetric";
  EXPECT_TRUE(says(refusal(s), {"backend", "\"symetric\"", "did you mean symmetric?"})) << refusal(s);
  s.backend = "octree";
  EXPECT_TRUE(says(refusal(s), {"backend", "\"octree\"", "naive, naive_omp", "symmetric_tbb"})) << refusal(s);
  s = good;
  s.interaction = "ferrari";
  EXPECT_TRUE(says(refusal(s), {"interaction", "\"ferrari\"", "ferrari09", "count"})) << refusal(s);
  s = good;
  s.smoothing = "wendland";
  EXPECT_TRUE(says(refusal(s), {"smoothing", "\"wendland\"", "wendland_c2"})) << refusal(s);
  s = good;
  s.precision = "half";
  EXPECT_TRUE(says(refusal(s), {"precision", "\"half\"", "double"})) << refusal(s);
  s = good;
  s.grid = "tree";
  EXPECT_TRUE(says(refusal(s), {"grid", "\"tree\"", "hashed_grid"})) << refusal(s);
  s = good;
  s.dim = 7;
  EXPECT_TRUE(says(refusal(s), {"dimension", "\"7\"", "valid: ", "3"})) << refusal(s);
  EXPECT_NE(error_of([&] { (void)registry::instance().make_reference(s); }), "");
}

TEST(registry, a_backend_that_was_not_compiled_for_a_dimension_says_so) {
  registry r;
  r.add(backend_entry{{.name = "of_another_build"}, [](int, bool) { return std::unique_ptr<any_schedule>(); }});
  r.add(counting_formula<3>());
  const setup s = with(make_scene("dam_break", 0.1, "rest").world, "of_another_build", 3, "count");
  EXPECT_TRUE(says(error_of([&] { (void)r.make_summation(s); }), {"of_another_build", "3D in double", "PAIRSUM_DIMS"}));
}

TEST(registry, an_unavailable_backend_is_listed_and_says_what_it_needs) {
  registry r;
  r.add(backend_entry{{.name = "cuda"}, nullptr, "needs CUDA"});
  EXPECT_EQ(r.backends().size(), 1u);
  EXPECT_TRUE(says(error_of([&] { (void)r.find_backend("cuda"); }), {"cuda", "unavailable", "needs CUDA"}));
}

}  // namespace
}  // namespace pairsum

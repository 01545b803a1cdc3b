#include <gtest/gtest.h>

#include <pairsum/core/isa.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/sum/registry.hpp>

namespace pairsum {
namespace {

using texts = std::vector<std::string>;

TEST(nearest, edit_distances_are_those_counted_by_hand) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // Wagner and Fischer's kind: two changed, one added
  EXPECT_EQ(edit_distance("symetric", "symmetric"), 1u);
  EXPECT_EQ(edit_distance("tlak", "talk"), 1u);  // two neighbours swapped
  EXPECT_EQ(edit_distance("ca", "abc"), 3u);     // nothing is edited between swapped letters
  EXPECT_EQ(edit_distance("Euler", "euler"), 0u);
}

TEST(nearest, is_symmetric_and_obeys_the_bounds_of_lengths) {
  const texts some{"", "a", "naive", "naive_omp", "tiles_tbb", "colour18", "wendland_c2", "thread_private"};
  for (const std::string& a : some)
    for (const std::string& b : some) {
      const std::size_t d = edit_distance(a, b);
      EXPECT_EQ(d, edit_distance(b, a));
      EXPECT_EQ(d == 0, a == b);
      EXPECT_LE(d, std::max(a.size(), b.size()));
      EXPECT_GE(d, std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
    }
}

TEST(nearest, finds_what_was_misspelt_or_begun_and_nothing_far_away) {
  const texts valid{"naive", "naive_omp", "naive_tbb", "symmetric", "symmetric_omp", "colour18", "colour4"};
  EXPECT_EQ(nearest_words("symetric_opm", valid), (texts{"symmetric_omp"}));
  EXPECT_EQ(nearest_words("color18", valid), (texts{"colour18"}));
  EXPECT_EQ(nearest_words("NAIVE", valid), (texts{"naive"}));
  EXPECT_EQ(nearest_words("colour", valid), (texts{"colour18", "colour4"}));
  EXPECT_EQ(nearest_words("naive_", valid), (texts{"naive", "naive_omp", "naive_tbb"}));
  for (const char* far : {"", "x", "nope", "verlet", "octree", "a_word_that_is_far_from_all"})
    EXPECT_TRUE(nearest_words(far, valid).empty()) << far;
  EXPECT_EQ(nearest_words("b", {"a", "c"}), texts{});
  EXPECT_EQ(nearest_words("word", {"word1", "word2", "word3", "word4"}).size(), 3u);  // no more
}

std::string said_of(const auto& call) {
  try {
    call();
  } catch (const error& e) {
    return e.what();
  }
  return "";
}

TEST(nearest, is_said_wherever_a_word_is_unknown) {
  EXPECT_EQ(unknown_name("state", "perturbd", texts{"rest", "perturbed"}).what(),
            std::string("unknown state \"perturbd\"; did you mean perturbed? valid: rest, perturbed"));
  EXPECT_EQ(unknown_name("state", "frozen", texts{"rest", "perturbed"}).what(),
            std::string("unknown state \"frozen\"; valid: rest, perturbed"));
  texts many(12, "perturbed");
  many.emplace_back("frozen");
  EXPECT_EQ(unknown_name("word", "frozem", many).what(),
            std::string("unknown word \"frozem\"; did you mean frozen?"));  // and no long list behind it
  const registry& r = registry::instance();
  const auto says = [](const std::string& text, const std::string& hint) {
    return text.find("; did you mean " + hint + "?") != text.npos;
  };
  EXPECT_TRUE(says(said_of([&] { (void)r.find_backend("symmetric_opm"); }), "symmetric_omp"));
  EXPECT_TRUE(says(said_of([&] { r.check_interaction("ferari09"); }), "ferrari09"));
  EXPECT_TRUE(says(said_of([&] { r.check_precision("doubel"); }), "double"));
  EXPECT_TRUE(says(said_of([] { check_isa("scaler"); }), "scalar"));
  EXPECT_EQ(said_of([&] { (void)r.find_backend("octree"); }).find("did you mean"), std::string::npos);
}

TEST(nearest, a_word_that_is_not_built_is_meant_too) {
  registry r = registry::instance();
  r.add_missing({"precision", "quadruple", "PAIRSUM_PRECISIONS"});
  const std::string text = said_of([&] { r.check_precision("quadrupel"); });
  EXPECT_NE(text.find("; did you mean quadruple? (not in this build; built: "), text.npos) << text;
  EXPECT_THROW(r.check_precision("quadruple"), unavailable);
  EXPECT_NO_THROW(r.check_precision("double"));
}

}  // namespace
}  // namespace pairsum

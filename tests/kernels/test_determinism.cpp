#include <gtest/gtest.h>

#include <cmath>

#include "scene.hpp"

namespace pairsum {
namespace {

using namespace test_kit;

class determinism_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(backend, determinism_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

/// What goes wrong by chance may go right three times.
TEST_P(determinism_test, fingerprint_is_the_same_twenty_times) {
  const auto& traits = registry::instance().find_backend(GetParam()).traits;
  if (!traits.deterministic) GTEST_SKIP() << GetParam() << " does not claim to be deterministic";
  const scene s = make_scene("dam_break", 0.03, "perturbed");
  for (const grid_choice& grid : {grid_choice(3), grid_choice("compact_grid", 0)}) {
    const setup world = with(s.world, GetParam(), grid);
    const auto expected = evaluated(world, s.particles, 1)->fingerprint();
    const auto sum = registry::instance().make_summation(world);
    for (const int threads : {2, 3, 4, 8}) {
      workers w(traits.threads, threads);
      sum->load(s.particles, {});
      for (int run = 0; run < 20; ++run) {
        sum->evaluate(w.get());
        ASSERT_EQ(sum->fingerprint(), expected) << grid << " threads=" << threads << " run " << run;
      }
    }
  }
}

/// An input that moves by one ulp may or may not move the rates; the fingerprint must say which.
TEST_P(determinism_test, fingerprint_changes_if_and_only_if_the_rates_do) {
  scene s = make_scene("dam_break", 0.08, "perturbed");
  const auto sum = evaluated(with(s.world, GetParam(), 4), s.particles);
  workers w(sum->traits().threads, 1);
  int changes = 0;
  for (int ulp = 0; ulp < 30; ++ulp) {
    const auto rates = sum->rates().columns;
    const auto fingerprint = sum->fingerprint();
    s.particles.v[0][17] = std::nextafter(s.particles.v[0][17], 1e9);
    sum->load(s.particles, {});
    sum->evaluate(w.get());
    const bool changed = sum->rates().columns != rates;
    EXPECT_EQ(sum->fingerprint() != fingerprint, changed) << "ulp " << ulp;
    changes += changed;
  }
  EXPECT_GT(changes, 0);
}

/// In id order, whatever the order of memory: equal rates have equal fingerprints.
TEST(determinism, fingerprint_does_not_depend_on_the_order_of_memory) {
  const scene s = make_scene("dam_break", 0.08, "perturbed");
  const auto sum = registry::instance().make_summation(with(s.world, "symmetric", 4, "count"));
  sum->load(s.particles, {});
  sum->evaluate(team());
  const auto expected = sum->fingerprint();
  std::vector<std::uint32_t> backwards;
  for (auto i = static_cast<std::uint32_t>(s.particles.size()); i > 0; --i) backwards.push_back(i - 1);
  sum->load(s.particles, backwards);
  sum->evaluate(team());
  EXPECT_EQ(sum->fingerprint(), expected);
}

}  // namespace
}  // namespace pairsum

#include <gtest/gtest.h>

#include "../harness/broken_registry.hpp"
#include "scene.hpp"

// Verification must reject a backend that is wrong in a single pair, and accept the same backend without the fault.
namespace pairsum {
namespace {

using namespace test_kit;

TEST(broken_backends, one_wrong_pair_is_rejected) {
  const scene s = make_scene("dam_break", 0.055, "perturbed");
  const registry broken = broken_registry();
  for (const char* interaction : {"ferrari09", "count"})
    for (const int M : {2, 4, 6}) {
      const setup world = with(s.world, "", M, interaction);
      const expectation e = broken.make_reference(world)->brute_force(s.particles, some_threads());
      for (const backend_entry& b : broken.backends()) {
        const auto sum = broken.make_summation(with(world, b.traits.name, M, interaction));
        sum->load(s.particles, {});
        sum->evaluate(team());
        const std::string text = disagreement(sum->rates(), e);
        EXPECT_EQ(text == "", b.traits.name == name_of(fault::none)) << b.traits.name << " M=" << M << ": " << text;
      }
    }
}

}  // namespace
}  // namespace pairsum

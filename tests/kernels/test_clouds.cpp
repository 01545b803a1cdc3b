#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "cloud.hpp"

// Random clouds of every shape for every backend against brute force.
namespace rc {
template <>
struct Arbitrary<pairsum::test_kit::cloud> {
  static Gen<pairsum::test_kit::cloud> arbitrary() {
    using pairsum::test_kit::cloud;
    return gen::build<cloud>(gen::set(&cloud::form, gen::elementOf(pairsum::test_kit::shapes)),
                             gen::set(&cloud::fluid, gen::inRange(0u, 200u)),
                             gen::set(&cloud::boundary, gen::inRange(0u, 100u)),
                             gen::set(&cloud::length, gen::element(0.4, 1.0, 2.5, 4.0, 7.3, 20.0)),
                             gen::set(&cloud::corner, gen::element(0.0, -0.5, 3.7, -1e3, 1e6, -1e9)),
                             gen::set(&cloud::H, gen::element(0.1, 1.0, 0.01188, 50.0)),
                             gen::set(&cloud::M, gen::inRange(2, 6)), gen::set(&cloud::seed, gen::inRange(1, 1000000)));
  }
};
}  // namespace rc

namespace pairsum {
namespace {

using namespace test_kit;

class clouds_test : public testing::TestWithParam<std::string> {
 protected:
  static void expect_agreement(const std::string& interaction, int threads) {
    EXPECT_TRUE(rc::check(GetParam() + ", " + interaction, [&](const cloud& c) {
      const scene s = make_cloud(c);
      const setup world = with(s.world, GetParam(), c.M, interaction);
      const auto sum = registry::instance().make_summation(world);
      workers w(sum->traits().threads, threads);
      sum->load(s.particles, shuffled(s.particles.size(), c.seed));
      sum->evaluate(w.get());
      const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, team());
      RC_ASSERT(disagreement(sum->rates(), expected) == "");
      const work_counts n = sum->count_work();
      RC_ASSERT(n.pairs_fluid_fluid == expected.pairs_fluid_fluid);
      RC_ASSERT(n.pairs_fluid_boundary == expected.pairs_fluid_boundary);
      RC_TAG(expected.pairs_fluid_fluid == 0 ? "no pair" : "pairs");
    }));
  }
};
INSTANTIATE_TEST_SUITE_P(backend, clouds_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

TEST_P(clouds_test, are_summed_within_the_bound) { expect_agreement("ferrari09", 3); }
TEST_P(clouds_test, are_counted_exactly) { expect_agreement("count", 2); }

/// The reference's cell search, which verifies what is too large for brute force.
TEST(clouds, cell_search_finds_the_pairs_of_brute_force) {
  EXPECT_TRUE(rc::check("cell search", [](const cloud& c) {
    const scene s = make_cloud(c);
    const auto oracle = registry::instance().make_reference(with(s.world, "naive", 2, "count"));
    const expectation brute = oracle->brute_force(s.particles, team());
    const expectation cell = oracle->cell_search(s.particles, team());
    RC_ASSERT(cell.value == brute.value);
    RC_ASSERT(cell.pairs_fluid_fluid == brute.pairs_fluid_fluid);
    RC_ASSERT(cell.pairs_fluid_boundary == brute.pairs_fluid_boundary);
  }));
}

TEST(clouds, have_the_shapes_they_claim) {
  cloud c;
  c.fluid = 100;
  c.length = 7;
  const auto pairs = [&](shape form) {
    c.form = form;
    const scene s = make_cloud(c);
    return registry::instance()
        .make_reference(with(s.world, "naive", 2))
        ->brute_force(s.particles, team())
        .pairs_fluid_fluid;
  };
  EXPECT_EQ(pairs(shape::one_cell), 100u * 99 / 2) << "all are in reach of each other";
  EXPECT_GE(pairs(shape::coincident), 5u * 20 * 19 / 2) << "five points of 20 particles";
  EXPECT_GT(pairs(shape::clustered), pairs(shape::uniform));
  EXPECT_GT(pairs(shape::line), pairs(shape::plane));
}

}  // namespace
}  // namespace pairsum

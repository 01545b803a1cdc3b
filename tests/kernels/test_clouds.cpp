#include <gtest/gtest.h>

#include "any_cloud.hpp"

// Random clouds of every shape in every dimension and precision, for every backend, against brute force.
namespace pairsum {
namespace {

using namespace test_kit;

class clouds_test : public testing::TestWithParam<std::string> {
 protected:
  template <class Wanted>
  static void expect_agreement(Wanted wanted) {
    EXPECT_TRUE(rc::check(GetParam(), [&](const cloud& c) {
      const formula f = *rc::gen::suchThat(any_formula(c.dim, GetParam()), wanted);
      const scene s = make_cloud(c);
      const setup world = with(s.world, f, GetParam(), c.choice());
      const auto sum = registry::instance().make_summation(world);
      if (f.interaction == "monaghan94" && touching(s.particles, f.precision)) {
        RC_ASSERT(says(error_of([&] { sum->load(s.particles, {}); }), {"fluid particle", "lies exactly on boundary"}));
        RC_SUCCEED("refused");
      }
      workers w(sum->traits().threads, *rc::gen::element(1, 1, 1, 3));
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

TEST_P(clouds_test, are_summed_within_the_bound) {
  expect_agreement([](const formula& f) { return f.interaction != "count"; });
}
TEST_P(clouds_test, are_counted_exactly) {
  expect_agreement([](const formula& f) { return f.interaction == "count"; });
}

/// The reference's cell search, which verifies what is too large for brute force.
TEST(clouds, cell_search_finds_the_pairs_of_brute_force) {
  EXPECT_TRUE(rc::check("cell search", [](const cloud& c) {
    const auto counts = [](const formula& a) { return a.interaction == "count"; };
    const formula f = *rc::gen::suchThat(any_formula(c.dim, "naive"), counts);
    const scene s = make_cloud(c);
    const auto oracle = registry::instance().make_reference(with(s.world, f));
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

#include <gtest/gtest.h>

#include "any_cloud.hpp"
#include "periodic_box.hpp"

// Random clouds in periodic boxes of every proportion, for every backend, grid, dimension and precision.
namespace pairsum {
namespace {

using namespace test_kit;

/// Boxes from the smallest with 4 cells to 20 H, cubes and others; H is a power of two now and then, so that cells may
/// be H wide exactly.
struct periodic_cloud {
  cloud c;
  std::array<double, 3> stretch;
};
std::ostream& operator<<(std::ostream& o, const periodic_cloud& p) {
  return o << p.c << " stretched " << p.stretch[0] << " " << p.stretch[1] << " " << p.stretch[2];
}

rc::Gen<periodic_cloud> any_periodic_cloud(const std::string& precision) {
  return rc::gen::exec([precision] {
    periodic_cloud p{*rc::gen::arbitrary<cloud>(), {1, 1, 1}};
    p.c.H = *rc::gen::element(0.125, 0.1, 0.01188, 1.0, 50.0);
    p.c.length = *rc::gen::element(4.0, 4.1, 5.3, 8.0, 12.5, 16.0);
    const bool wide = precision != "float";  // a float of 1e6 does not resolve H
    p.c.corner = *rc::gen::element(0.0, 0.0, -0.5, 3.7, wide ? 1e6 : -7.0);
    for (double& a : p.stretch) a = *rc::gen::element(1.0, 1.0, 1.3, 2.0);
    return p;
  });
}

class periodic_clouds_test : public testing::TestWithParam<std::string> {
 protected:
  template <class Wanted>
  static void expect_agreement(Wanted wanted) {
    EXPECT_TRUE(rc::check(GetParam(), [&] {
      const auto dim = *rc::gen::elementOf(registry::instance().dims());
      const formula f = *rc::gen::suchThat(any_formula(dim, GetParam()), wanted);
      periodic_cloud p = *any_periodic_cloud(f.precision);
      p.c.dim = dim;
      const scene s = make_periodic(p.c, p.stretch);
      setup world = with(s.world, f, GetParam(), p.c.choice());
      if (!goes_round(world)) {
        RC_ASSERT(says(error_of([&] { (void)registry::instance().make_summation(world); }), {"periodic box"}));
        world.M = 2;
        RC_PRE(goes_round(world));
      }
      if (f.interaction == "monaghan94" && touching(s.particles, f.precision)) RC_SUCCEED("not to be summed");
      const auto sum = registry::instance().make_summation(world);
      workers w(sum->traits().threads, *rc::gen::element(1, 1, 1, 3));
      sum->load(s.particles, shuffled(s.particles.size(), p.c.seed));
      sum->evaluate(w.get());
      const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, team());
      RC_ASSERT(disagreement(sum->rates(), expected) == "");
      const work_counts n = sum->count_work();
      RC_ASSERT(n.pairs_fluid_fluid == expected.pairs_fluid_fluid);
      RC_ASSERT(n.pairs_fluid_boundary == expected.pairs_fluid_boundary);
      RC_ASSERT(sum->lost() == 0u);
      if (f.interaction == "count") RC_ASSERT(sum->rates().columns == count_by_hand(s, f.precision).columns);
      RC_TAG(expected.pairs_fluid_fluid == 0 ? "no pair" : "pairs");
    }));
  }
};
INSTANTIATE_TEST_SUITE_P(backend, periodic_clouds_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

TEST_P(periodic_clouds_test, are_summed_within_the_bound) {
  expect_agreement([](const formula& f) { return f.interaction != "count"; });
}
TEST_P(periodic_clouds_test, are_counted_exactly) {
  expect_agreement([](const formula& f) { return f.interaction == "count"; });
}

/// The reference's cell search, which verifies what is too large for brute force.
TEST(periodic_clouds, cell_search_finds_the_pairs_of_brute_force) {
  EXPECT_TRUE(rc::check("cell search", [] {
    const auto dim = *rc::gen::elementOf(registry::instance().dims());
    const auto counts = [](const formula& a) { return a.interaction == "count"; };
    const formula f = *rc::gen::suchThat(any_formula(dim, "naive"), counts);
    periodic_cloud p = *any_periodic_cloud(f.precision);
    p.c.dim = dim;
    const scene s = make_periodic(p.c, p.stretch);
    const auto oracle = registry::instance().make_reference(with(s.world, f));
    const expectation brute = oracle->brute_force(s.particles, team());
    const expectation cell = oracle->cell_search(s.particles, team());
    RC_ASSERT(cell.value == brute.value);
    RC_ASSERT(cell.pairs_fluid_fluid == brute.pairs_fluid_fluid);
    RC_ASSERT(cell.pairs_fluid_boundary == brute.pairs_fluid_boundary);
  }));
}

/// Whoever forgets the faces is found out.
TEST(periodic_clouds, an_open_box_has_other_rates) {
  cloud c;
  c.dim = registry::instance().dims().front();
  c.fluid = 200;
  c.length = 5.3;
  const scene s = make_periodic(c);
  setup open = counting(s, "naive", 2);
  open.dim = c.dim;
  const auto expected = registry::instance().make_reference(open)->brute_force(s.particles, team());
  EXPECT_EQ(disagreement(evaluated(open, s.particles)->rates(), expected), "");
  open.periodic = false;
  EXPECT_NE(disagreement(evaluated(open, s.particles)->rates(), expected), "");
}

}  // namespace
}  // namespace pairsum

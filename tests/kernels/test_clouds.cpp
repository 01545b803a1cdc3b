#include <gtest/gtest.h>

#include "any_cloud.hpp"
#include "periodic_box.hpp"

// Random clouds of every shape, in the open and in periodic boxes of every proportion, for every backend, grid,
// instruction set, dimension and precision, against brute force.
namespace pairsum {
namespace {

using namespace test_kit;

/// A cloud, and how its box is stretched, along which axes it is periodic.
struct any_box {
  cloud c;
  axes along{};
  std::array<double, 3> stretch{};
  bool periodic() const { return along.any(); }
  scene make() const { return periodic() ? make_periodic(c, stretch, along) : make_cloud(c); }
};
std::ostream& operator<<(std::ostream& o, const any_box& b) {
  return o << b.c << " periodic along " << b.along.text() << " stretched " << b.stretch[0] << " " << b.stretch[1] << " "
           << b.stretch[2];
}

/// Boxes from the smallest with 3 cells to 20 H, cubes and others; H is a power of two now and then, so that cells may
/// be H wide exactly.
rc::Gen<any_box> any_box_for(const formula_choice& f) {
  return rc::gen::exec([f] {
    any_box b{*rc::gen::arbitrary<cloud>()};
    b.c.dim = f.dim;
    if (*rc::gen::arbitrary<bool>()) return b;
    b.c.H = *rc::gen::element(0.125, 0.1, 0.01188, 1.0, 50.0);
    const auto which = *rc::gen::inRange(1, 1 << f.dim);
    for (int d = 0; d < f.dim; ++d) b.along.on[static_cast<std::size_t>(d)] = (which >> d & 1) != 0;
    b.c.length = *rc::gen::element(3.0, 3.5, 4.0, 4.1, 5.3, 8.0, 12.5, 16.0);
    const bool wide = f.precision != "float";  // a float of 1e6 does not resolve H
    b.c.corner = *rc::gen::element(0.0, 0.0, -0.5, 3.7, wide ? 1e6 : -7.0);
    for (double& a : b.stretch) a = *rc::gen::element(1.0, 1.0, 1.3, 2.0);
    return b;
  });
}

class clouds_test : public testing::TestWithParam<std::string> {
 protected:
  static void expect_agreement(const formula_choice& f) {
    const any_box b = *any_box_for(f);
    const scene s = b.make();
    setup world = with(s.world, f, GetParam(), b.c.choice());
    world.isa = *rc::gen::elementOf(isas_for(f, GetParam()));
    if (!goes_round(world)) {
      RC_ASSERT(says(error_of([&] { (void)registry::instance().make_summation(world); }), {"periodic box"}));
      world.M = 2;
      RC_PRE(goes_round(world));
    }
    const auto sum = registry::instance().make_summation(world);
    if (f.interaction == "monaghan94" && touching(s.particles, f.precision)) {
      if (b.periodic()) RC_SUCCEED("not to be summed");
      RC_ASSERT(says(error_of([&] { sum->load(s.particles, {}); }), {"fluid particle", "lies exactly on boundary"}));
      RC_SUCCEED("refused");
    }
    const workers w(sum->traits().threads, *rc::gen::element(1, 1, 1, 3));
    sum->load(s.particles, shuffled(s.particles.size(), b.c.seed));
    sum->evaluate(w.get());
    const auto expected = registry::instance().make_reference(world)->brute_force(s.particles, team());
    RC_ASSERT(disagreement(sum->rates(), expected) == "");
    const work_counts n = sum->count_work();
    RC_ASSERT(n.pairs_fluid_fluid == expected.pairs_fluid_fluid);
    RC_ASSERT(n.pairs_fluid_boundary == expected.pairs_fluid_boundary);
    RC_ASSERT(sum->lost() == 0u);
    if (f.interaction == "count" && b.periodic())
      RC_ASSERT(sum->rates().columns == count_by_hand(s, f.precision).columns);
    RC_TAG(expected.pairs_fluid_fluid == 0 ? "no pair" : "pairs");
  }
};
INSTANTIATE_TEST_SUITE_P(backend, clouds_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

TEST_P(clouds_test, are_summed_within_the_bound) {
  EXPECT_TRUE(rc::check(GetParam(), [] { expect_agreement(*some_formula(GetParam(), false)); }));
}
TEST_P(clouds_test, are_counted_exactly) {
  EXPECT_TRUE(rc::check(GetParam(), [] { expect_agreement(*some_formula(GetParam(), true)); }));
}

/// The reference's cell search, which verifies what is too large for brute force.
TEST(clouds, cell_search_finds_the_pairs_of_brute_force) {
  EXPECT_TRUE(rc::check("cell search", [] {
    const formula_choice f = *some_formula("naive", true);
    const any_box b = *any_box_for(f);
    const scene s = b.make();
    const auto oracle = registry::instance().make_reference(with(s.world, f));
    const expectation brute = oracle->brute_force(s.particles, team());
    const expectation cell = oracle->cell_search(s.particles, team());
    RC_ASSERT(cell.value == brute.value);
    RC_ASSERT(cell.pairs_fluid_fluid == brute.pairs_fluid_fluid);
    RC_ASSERT(cell.pairs_fluid_boundary == brute.pairs_fluid_boundary);
  }));
}

/// Whoever forgets the faces is found out.
TEST(clouds, an_open_box_has_other_rates) {
  cloud c;
  c.dim = registry::instance().dims().front();
  c.fluid = 200;
  c.length = 5.3;
  const scene s = make_periodic(c);
  setup open = counting(s, "naive", 2);
  open.dim = c.dim;
  const auto expected = registry::instance().make_reference(open)->brute_force(s.particles, team());
  EXPECT_EQ(disagreement(evaluated(open, s.particles)->rates(), expected), "");
  for (int d = 0; d < c.dim; ++d) {
    open.periodic = axes::all(c.dim);
    open.periodic.on[static_cast<std::size_t>(d)] = false;
    EXPECT_NE(disagreement(evaluated(open, s.particles)->rates(), expected), "") << "open along "
                                                                                 << "xyz"[d];
  }
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

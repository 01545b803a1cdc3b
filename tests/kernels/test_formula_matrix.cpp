#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "cloud.hpp"

// Every formula that is built with every function that schedules call, scalar and on every instruction set, on about
// 2000 particles, against an O(N^2) reference of the same precision and expression.
namespace pairsum {
namespace {

using namespace test_kit;

/// 1500 fluid and 500 boundary particles, about 30 neighbours each; every mass, density and velocity different.
scene crowd(int dim) {
  cloud c;
  c.dim = dim;
  c.fluid = 1500;
  c.boundary = 500;
  c.length = dim == 1 ? 100 : dim == 2 ? 14 : 6.5;
  c.corner = -0.37;
  return make_cloud(c);
}

/// A bound that lets anything pass, or a state in which terms are zero, would prove nothing.
void expect_sharp(const formula_choice& f, const expectation& e) {
  EXPECT_GT(e.pairs_fluid_fluid, 10000u);
  EXPECT_GT(e.pairs_fluid_boundary, 5000u);
  const double eps =
      f.precision == "double" ? std::numeric_limits<double>::epsilon() : std::numeric_limits<float>::epsilon();
  for (std::size_t c = 0; c < e.value.size(); ++c) {
    std::vector<double> sharpness;
    for (std::size_t k = 0; k < e.ids.size(); ++k) {
      EXPECT_GT(e.magnitude[c][k], 0);
      sharpness.push_back(e.bound[c][k] / e.magnitude[c][k] / eps);
    }
    std::ranges::sort(sharpness);
    const double middle = sharpness[sharpness.size() / 2];
    if (f.interaction == "count")
      EXPECT_EQ(middle, 0) << "count is exact";
    else
      EXPECT_LT(middle, 400) << e.names[c];
    testing::Test::RecordProperty("median_bound_in_eps_" + e.names[c], std::to_string(middle));
  }
}

class formula_matrix_test : public testing::TestWithParam<formula_choice> {};
INSTANTIATE_TEST_SUITE_P(every, formula_matrix_test, testing::ValuesIn(formulas()),
                         [](const auto& i) { return testing::PrintToString(i.param); });

TEST_P(formula_matrix_test, every_function_agrees_on_every_instruction_set) {
  const formula_choice& f = GetParam();
  const scene s = crowd(f.dim);
  const expectation e = registry::instance().make_reference(with(s.world, f))->brute_force(s.particles, some_threads());
  expect_sharp(f, e);
  for (const std::string& backend : callers)
    for (const std::string& isa : isas_for(f, backend))
      for (const grid_choice& grid : every_grid({3})) {
        setup world = with(s.world, f, backend, grid);
        world.isa = isa;
        ASSERT_EQ(disagreement(evaluated(world, s.particles, 2)->rates(), e), "")
            << backend << " " << isa << " " << grid;
      }
}

/// Each interaction in each dimension and precision, and with each smoothing kernel in some of them.
TEST(formula_matrix, covers_the_library) {
  const registry& r = registry::instance();
  std::set<std::tuple<int, std::string, std::string>> places;
  std::set<std::pair<std::string, std::string>> pairs;
  for (const formula_choice& f : formulas()) {
    places.emplace(f.dim, f.precision, f.interaction);
    pairs.emplace(f.interaction, f.smoothing);
  }
  const std::size_t smoothed = std::ranges::count_if(r.interactions(), [&](auto& i) { return r.is_smoothed(i); });
  const std::size_t plain = r.interactions().size() - smoothed;
  const std::size_t mixed = std::ranges::count(r.precisions(), "mixed");
  EXPECT_EQ(pairs.size(), smoothed * r.smoothings().size() + plain);
  EXPECT_EQ(places.size(), r.dims().size() * (r.precisions().size() * r.interactions().size() - mixed * plain));
}

}  // namespace
}  // namespace pairsum

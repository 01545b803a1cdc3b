#include <gtest/gtest.h>

#include "cloud.hpp"

// The smallest worlds.
namespace pairsum {
namespace {

using namespace test_kit;

class few_particles_test : public testing::TestWithParam<backend_on_grid> {
 protected:
  static std::unique_ptr<summation> sum_of(const scene& s, const std::string& interaction = "ferrari09") {
    return evaluated(on_grid(s.world, interaction), s.particles, 7);
  }
  static setup on_grid(const setup& world, const std::string& interaction) {
    return with(world, std::get<0>(GetParam()), std::get<1>(GetParam()), interaction);
  }
  static scene some(std::uint32_t fluid, std::uint32_t boundary) {
    cloud c;
    c.fluid = fluid;
    c.boundary = boundary;
    c.length = 0.4;  // all in reach of each other
    return make_cloud(c);
  }
};
INSTANTIATE_TEST_SUITE_P(every, few_particles_test,
                         testing::Combine(testing::ValuesIn(backend_names()), testing::ValuesIn(every_grid({3}))),
                         name_of_test);

TEST_P(few_particles_test, none) {
  const auto sum = sum_of(some(0, 0));
  const rate_table rates = sum->rates();
  for (const auto& column : rates.columns) EXPECT_TRUE(column.empty());
  const work_counts n = sum->count_work();
  EXPECT_EQ(n.pairs_tested + n.pairs_interacting() + n.cells_nonempty, 0u);
  EXPECT_EQ(sum->snapshot().size(), 0u);
}

TEST_P(few_particles_test, one) {
  const auto sum = sum_of(some(1, 0));
  const rate_table rates = sum->rates();
  for (const auto& column : rates.columns) EXPECT_EQ(column, std::vector<double>{0});
  EXPECT_EQ(sum->count_work().pairs_interacting(), 0u);
  EXPECT_EQ(sum->count_work().cells_nonempty, 1u);
}

TEST_P(few_particles_test, only_boundary) {
  const auto sum = sum_of(some(0, 50));
  const rate_table rates = sum->rates();
  for (const auto& column : rates.columns) EXPECT_EQ(column, std::vector<double>(50, 0));
  EXPECT_EQ(sum->count_work().pairs_tested, 0u) << "boundary pairs must cost nothing";
  EXPECT_EQ(sum->count_work().pairs_interacting(), 0u);
}

TEST_P(few_particles_test, one_fluid_and_one_boundary) {
  const auto rates = sum_of(some(1, 1), "count")->rates();
  EXPECT_EQ(rates.names, (std::vector<std::string>{"neighbours", "ids"}));
  EXPECT_EQ(rates.columns[0], (std::vector<double>{1, 0}));
  EXPECT_EQ(rates.columns[1], (std::vector<double>{1, 0})) << "the boundary's id is 1";
}

TEST_P(few_particles_test, two_fluid) {
  const auto rates = sum_of(some(2, 0), "count")->rates();
  EXPECT_EQ(rates.columns[0], (std::vector<double>{1, 1}));
  EXPECT_EQ(rates.columns[1], (std::vector<double>{1, 0}));
}

/// A second load must not see the first: fewer particles after more, then more again.
TEST_P(few_particles_test, loads_replace_each_other) {
  const scene many = some(90, 40);
  const auto sum = registry::instance().make_summation(on_grid(many.world, "count"));
  workers w(sum->traits().threads, 2);
  for (const auto& [fluid, boundary] : {std::pair{90u, 40u}, {0u, 0u}, {3u, 2u}, {0u, 5u}, {90u, 40u}}) {
    sum->load(some(fluid, boundary).particles, {});
    sum->evaluate(w.get());
    const rate_table rates = sum->rates();
    double sides = 0;
    for (const double n : rates.columns[0]) sides += n;
    EXPECT_EQ(sides, fluid == 0 ? 0 : fluid * (fluid - 1.0 + boundary));
  }
}

/// Pairs at r = H exactly do not interact, pairs just below do.
TEST_P(few_particles_test, the_reach_is_open) {
  scene s = some(2, 0);
  s.world.constants.H = 0.25;
  s.world.omega_low.assign(3, 0);
  s.world.omega_high.assign(3, 1);
  for (auto& x : s.particles.x) x = {0.5, 0.5};
  s.particles.x[0] = {0.25, 0.5};
  EXPECT_EQ(sum_of(s, "count")->rates().columns[0][0], 0);
  s.particles.x[0] = {std::nextafter(0.25, 1.0), 0.5};
  EXPECT_EQ(sum_of(s, "count")->rates().columns[0][0], 1);
}

}  // namespace
}  // namespace pairsum

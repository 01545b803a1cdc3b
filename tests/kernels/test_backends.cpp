#include <gtest/gtest.h>

#include "scene.hpp"

// Every backend, M and number of threads against brute force, on a state in which every term is
// alive.
namespace pairsum {
namespace {

using namespace test_kit;

const scene& perturbed() {
  static const scene s = make_scene("dam_break", 0.055, "perturbed");
  return s;
}

const expectation& expected(const std::string& interaction) {
  static std::map<std::string, expectation> known;
  auto& e = known[interaction];
  if (e.ids.empty())
    e = registry::instance()
            .make_reference(with(perturbed().world, "naive", 2, interaction))
            ->brute_force(perturbed().particles, some_threads());
  return e;
}

TEST(backends, the_state_is_alive) {
  EXPECT_EQ(perturbed().particles.count(particle_kind::fluid), 1000u);
  const expectation& e = expected("ferrari09");
  EXPECT_GT(e.pairs_fluid_boundary, 1000u);
  for (std::size_t c = 0; c < e.value.size(); ++c)
    for (std::size_t k = 0; k < e.ids.size(); ++k) {
      EXPECT_NE(e.value[c][k], 0);
      EXPECT_LT(e.bound[c][k], 1e-12 * e.magnitude[c][k]) << "the bound would let anything pass";
    }
}

class backends_test : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(backend, backends_test, testing::ValuesIn(backend_names()),
                         [](const auto& i) { return i.param; });

void agrees(const std::string& backend, const std::string& interaction) {
  for (int M = 2; M <= 7; ++M) {
    const auto sum = registry::instance().make_summation(with(perturbed().world, backend, M, interaction));
    for (const int threads : {1, 2, 3, 7}) {
      workers w(sum->traits().threads, threads);
      sum->load(perturbed().particles, {});
      sum->evaluate(w.get());
      EXPECT_EQ(disagreement(sum->rates(), expected(interaction)), "") << "M=" << M << " threads=" << threads;
    }
  }
}

TEST_P(backends_test, is_within_the_bound_of_brute_force) { agrees(GetParam(), "ferrari09"); }

TEST_P(backends_test, counts_exactly) {
  agrees(GetParam(), "count");
  for (const auto& column : expected("count").bound)
    for (const double b : column) ASSERT_EQ(b, 0) << "count is exact";
}

TEST_P(backends_test, order_of_memory_does_not_matter) {
  initial_condition c;
  c.particles = perturbed().particles;
  c.omega_low = perturbed().world.omega_low;
  c.H = perturbed().world.constants.H;
  const auto sum = registry::instance().make_summation(with(perturbed().world, GetParam(), 5));
  workers w(sum->traits().threads, 2);
  for (const auto name : memory_orders) {
    sum->load(c.particles, memory_order(name, c, 3));
    sum->evaluate(w.get());
    EXPECT_EQ(disagreement(sum->rates(), expected("ferrari09")), "") << name;
  }
}

TEST(disagreement, rejects) {
  const expectation& e = expected("ferrari09");
  const auto sum = evaluated(with(perturbed().world, "symmetric", 4), perturbed().particles);
  const rate_table good = sum->rates();
  ASSERT_EQ(disagreement(good, e), "");
  rate_table bad = good;
  bad.columns[2][500] += 3 * e.bound[2][500];
  EXPECT_TRUE(says(disagreement(bad, e), {"dv_y of particle 500 is"})) << disagreement(bad, e);
  bad = good;
  bad.columns[0][999] = std::nan("");
  EXPECT_TRUE(says(disagreement(bad, e), {"drho of particle 999 is nan"}));
  bad = good;
  bad.columns[1][1500] = 1e-300;  // a boundary particle
  EXPECT_TRUE(says(disagreement(bad, e), {"dv_x of particle 1500 is", "not 0"}));
  expectation anything = e;
  anything.bound[1][7] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(says(disagreement(good, anything), {"dv_x of particle 7 is"})) << "an infinite bound bounds nothing";
  bad = good;
  bad.names[1] = "dv";
  EXPECT_EQ(disagreement(bad, e), "other columns");
}

}  // namespace
}  // namespace pairsum

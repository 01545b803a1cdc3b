#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <pairsum/cases/case.hpp>
#include <pairsum/sum/registry.hpp>

namespace pairsum {
namespace {

const initial_condition& water() {
  static const initial_condition c = make_case("dam_break", {.dx = 0.06, .state = "perturbed"});
  return c;
}

TEST(memory_order, every_order_is_a_permutation) {
  for (const auto name : memory_orders) {
    auto order = memory_order(name, water(), 3);
    ASSERT_EQ(order.size(), water().particles.size());
    std::ranges::sort(order);
    for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i) << name;
  }
}

TEST(memory_order, lattice_is_as_made) {
  const auto order = memory_order("lattice", water(), 3);
  EXPECT_TRUE(std::ranges::is_sorted(order));
}

TEST(memory_order, shuffled_depends_on_the_seed_alone) {
  const auto a = memory_order("shuffled", water(), 3);
  EXPECT_EQ(a, memory_order("shuffled", water(), 3));
  EXPECT_NE(a, memory_order("shuffled", water(), 4));
  std::size_t fixed = 0;
  for (std::uint32_t i = 0; i < a.size(); ++i) fixed += a[i] == i;
  EXPECT_LT(fixed, 20u);
}

/// Mean distance of particles that follow each other, in units of H.
double mean_jump(const std::vector<std::uint32_t>& order) {
  const auto& p = water().particles;
  double sum = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    const std::uint32_t a = order[k - 1], b = order[k];
    sum += std::hypot(p.x[0][a] - p.x[0][b], p.x[1][a] - p.x[1][b], p.x[2][a] - p.x[2][b]);
  }
  return sum / static_cast<double>(order.size() - 1) / water().H;
}

TEST(memory_order, morton_ascends_along_the_z_curve) {
  const auto order = memory_order("morton", water(), 3);
  const auto& p = water().particles;
  const auto z_curve = [&](std::uint32_t i) {  // by shifting single bits, x lowest
    std::uint64_t key = 0;
    for (int d = 0; d < 3; ++d) {
      const auto cell = static_cast<std::uint64_t>((p.x[d][i] - water().omega_low[d]) / water().H);
      for (int bit = 0; bit < 16; ++bit) key |= (cell >> bit & 1) << (3 * bit + d);
    }
    return key;
  };
  for (std::size_t k = 1; k < order.size(); ++k) {
    ASSERT_LE(z_curve(order[k - 1]), z_curve(order[k]));
    if (z_curve(order[k - 1]) == z_curve(order[k])) {
      ASSERT_LT(order[k - 1], order[k]) << "stable";
    }
  }
  EXPECT_LT(mean_jump(order), 2);
  EXPECT_GT(mean_jump(memory_order("shuffled", water(), 3)), 5);
}

}  // namespace
}  // namespace pairsum

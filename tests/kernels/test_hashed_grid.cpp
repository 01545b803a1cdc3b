#include <pairsum/grid/hashed_grid.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include <pairsum/core/memory.hpp>
#include <pairsum/core/random.hpp>
#include "scene.hpp"

namespace pairsum {
namespace {

using test_kit::error_of;
using test_kit::says;

const box<3, double> unit{vec<3, double>(0, 0, 0), vec<3, double>(1, 1, 1)};

TEST(hashed_grid, refuses_M_outside_its_range) {
  for (const int M : {0, 1, 40, -3, 11}) {
    const auto text = error_of([&] { hashed_grid<3, double>(unit, 0.1, M); });
    EXPECT_TRUE(says(text, {"M must be between 2 and 10 in 3D, is " + std::to_string(M)})) << text;
  }
  EXPECT_TRUE(says(error_of([] { hashed_grid<3, double>(unit, 0.1, 1); }), {"-1 and +1 are one cell"}));
  const box<2, double> square{vec<2, double>(0, 0), vec<2, double>(1, 1)};
  const box<1, double> line{vec<1, double>(0), vec<1, double>(1)};
  EXPECT_TRUE(says(error_of([&] { hashed_grid<2, double>(square, 0.1, 16); }), {"2 and 15 in 2D"}));
  EXPECT_TRUE(says(error_of([&] { hashed_grid<1, double>(line, 0.1, 31); }), {"2 and 30 in 1D"}));
  EXPECT_EQ(error_of([&] { hashed_grid<2, double>(square, 0.1, 2); }), "");
  EXPECT_EQ(error_of([&] { hashed_grid<3, double>(unit, 0.1, 8); }), "");
}

TEST(hashed_grid, refuses_M_through_the_registry) {
  const setup s = test_kit::make_scene("dam_break", 0.1, "rest").world;
  const auto text = error_of([&] { (void)registry::instance().make_summation(test_kit::with(s, "naive", 40)); });
  EXPECT_TRUE(says(text, {"between 2 and 10", "40"})) << text;
}

TEST(zero_table, refuses_what_memory_cannot_hold) {
  const auto text = error_of([] { zero_table(std::size_t{1} << 50, "the table of the test"); });
  EXPECT_TRUE(says(text, {"the table of the test", "GiB of memory", "smaller M"})) << text;
}

TEST(check_memory, refuses_more_than_the_machine_has_and_nothing_less) {
  EXPECT_TRUE(says(error_of([] { check_memory(1e18, "a case", "a larger dx takes less"); }),
                   {"a case would take", "this machine has", "a larger dx"}));
  EXPECT_EQ(error_of([] { check_memory(1 << 20, "a case", "advice"); }), "");
}

TEST(zero_table, is_zero_and_moves) {
  zero_table a(100000, "a table");
  for (std::size_t k = 0; k < a.size(); ++k) ASSERT_EQ(a.data()[k], 0u);
  a.data()[7] = 3;
  const zero_table b = std::move(a);
  EXPECT_EQ(b.data()[7], 3u);
  EXPECT_EQ(b.size(), 100000u);
}

template <class R>
class safe_width_test : public testing::Test {
 protected:
  static constexpr R far = std::numeric_limits<R>::infinity();
  const box<3, R> omega{vec<3, R>(0, R(-0.7), R(0.1)), vec<3, R>(R(3.3), R(1.8), R(0.61))};
  const R H = R(0.01188);
  static constexpr int wanted = 100000;

  /// Meets `wanted` pairs along axis d that pass the distance test, one particle within an ulp or
  /// two of a face of cells of width `face`, the other just under H further: how many are `apart`?
  template <class Apart>
  int count(R face, int d, Apart&& apart) const {
    const counter_random random(11, static_cast<std::uint64_t>(d));
    const R low = omega.low[d], length = omega.high[d] - low;
    int n = 0, pairs = 0;
    for (std::uint64_t k = 0; pairs < wanted && k < 40u * wanted; k += 4) {
      vec<3, R> a = omega.low, b = omega.low;
      a[d] = low + std::floor(static_cast<R>(random.uniform(k)) * (length / face - 1)) * face;
      const R way = random.bits(k + 2) & 1 ? far : -far;
      for (auto ulps = random.bits(k + 1) % 3; ulps > 0; --ulps) a[d] = std::nextafter(a[d], way);
      b[d] = a[d] + H;
      for (auto ulps = random.bits(k + 3) % 4; ulps > 0; --ulps) b[d] = std::nextafter(b[d], -far);
      if (!omega.contains(a) || !omega.contains(b) || !(norm2<3, R>(a - b) < H * H)) continue;
      ++pairs;
      n += apart(a, b);
    }
    EXPECT_EQ(pairs, wanted) << "axis " << d;
    return n;
  }
};
using precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(safe_width_test, precisions);

TYPED_TEST(safe_width_test, pairs_in_reach_are_never_two_cells_apart) {
  using R = TypeParam;
  const int M = 6;
  const std::uint32_t mask = (1u << M) - 1;
  const hashed_grid<3, R> grid(this->omega, this->H, M);
  ASSERT_GE(grid.cell_width(), this->H);
  ASSERT_LT(grid.cell_width(), R(1.001) * this->H);
  particle_set<3, R> pair;
  pair.resize(2);
  for (int d = 0; d < 3; ++d)
    for (const R face : {grid.cell_width(), this->H}) {
      const int apart = this->count(face, d, [&](const vec<3, R>& a, const vec<3, R>& b) {
        for (int k = 0; k < 3; ++k) pair.x[k][0] = a[k], pair.x[k][1] = b[k];
        std::array<std::uint32_t, 2> keys;
        grid.keys(pair, 0, 2, keys);
        return (((keys[1] >> (d * M)) - (keys[0] >> (d * M))) & mask) > 1;  // on the torus; b > a
      });
      EXPECT_EQ(apart, 0) << "axis " << d;
    }
}

/// With w = H exactly the rounding of (x-A)/w does put some of them two cells apart: the pairs are
/// sharp enough to see it.
TYPED_TEST(safe_width_test, the_same_pairs_reject_a_width_of_exactly_H) {
  using R = TypeParam;
  int apart = 0;
  for (int d = 0; d < 3; ++d)
    apart += this->count(this->H, d, [&](const vec<3, R>& a, const vec<3, R>& b) {
      const auto cell = [&](R x) { return std::floor((x - this->omega.low[d]) * (1 / this->H)); };
      return cell(b[d]) - cell(a[d]) > 1;
    });
  EXPECT_GT(apart, 0);
}

}  // namespace
}  // namespace pairsum

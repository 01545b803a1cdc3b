#include <pairsum/core/random.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>

namespace pairsum {
namespace {

// First outputs, computed outside this project (Python integers) from the documented definition.
static_assert(counter_random(0).bits(0) == 0x568a9b0b1a2c05ec && counter_random(0).bits(1) == 0x44e5b8b147ef718b);
static_assert(counter_random(1).bits(0) == 0x6ec85f1f8547bc0c);
static_assert(counter_random(1, 1).bits(0) == 0x5c5b2489b31beb7b && counter_random(1, 1).bits(1) == 0xe6c3d212b3317fcc);
static_assert(counter_random(~0ull, ~0ull).bits(~0ull) == 0x7ba8e05e958e39ce);
static_assert(counter_random(1, 1).uniform(0) == 0.3607657276325963);
static_assert(counter_random(1, 1).uniform(0, -1, 3) == -1 + 4 * 0.3607657276325963);

constexpr std::uint64_t many = 100000;

TEST(counter_random, is_uniform) {
  for (const std::uint64_t seed : {1, 2, 12345}) {
    const counter_random random(seed, 3);
    double sum = 0, squares = 0;
    std::array<int, 16> bins{};
    for (std::uint64_t k = 0; k < many; ++k) {
      const double u = random.uniform(k);
      ASSERT_GE(u, 0);
      ASSERT_LT(u, 1);
      ASSERT_EQ(std::ldexp(u, 53), std::floor(std::ldexp(u, 53))) << "a multiple of 2^-53";
      sum += u;
      squares += u * u;
      ++bins[static_cast<std::size_t>(16 * u)];
    }
    const double n = many;
    EXPECT_NEAR(sum / n, 0.5, 5 * std::sqrt(1 / (12 * n)));  // five standard errors
    EXPECT_NEAR(squares / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / n));
    for (const int b : bins) EXPECT_NEAR(b, n / 16, 5 * std::sqrt(n / 16));
  }
}

TEST(counter_random, every_bit_is_set_half_of_the_time) {
  const counter_random random(4);
  std::array<int, 64> set{};
  for (std::uint64_t k = 0; k < many; ++k)
    for (std::size_t b = 0; b < 64; ++b) set[b] += random.bits(k) >> b & 1;
  for (const int n : set) EXPECT_NEAR(n, many / 2, 5 * std::sqrt(many / 4.0));
}

TEST(counter_random, does_not_depend_on_the_order_of_calls) {
  const counter_random random(8, 1);
  const auto late = random.bits(1000);
  for (std::uint64_t k = 0; k < 1000; ++k) (void)random.bits(k);
  EXPECT_EQ(random.bits(1000), late);
  EXPECT_EQ(counter_random(8, 1).bits(1000), late);
}

TEST(counter_random, seeds_streams_and_counters_differ) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (std::uint64_t stream = 0; stream < 20; ++stream)
      for (std::uint64_t k = 0; k < 20; ++k) seen.insert(counter_random(seed, stream).bits(k));
  EXPECT_EQ(seen.size(), 8000u);
  int flipped = 0;  // neighbouring counters differ in about half of their bits
  const counter_random random(1);
  for (std::uint64_t k = 0; k < 1000; ++k) flipped += std::popcount(random.bits(k) ^ random.bits(k + 1));
  EXPECT_NEAR(flipped / 1000.0, 32, 1);
}

TEST(counter_random, stays_in_the_given_interval) {
  const counter_random random(6);
  for (std::uint64_t k = 0; k < many; ++k) {
    const double u = random.uniform(k, -0.05, 0.05);
    ASSERT_GE(u, -0.05);
    ASSERT_LT(u, 0.05);
  }
}

}  // namespace
}  // namespace pairsum

#include <pairsum/grid/counting_sort.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include <pairsum/core/random.hpp>
#include <pairsum/particles/reorder.hpp>
#include "scene.hpp"

namespace pairsum {
namespace {

using order = std::vector<std::uint32_t>;

order random_keys(std::size_t n, int bits, std::uint64_t seed) {
  const counter_random random(seed);
  order keys(n);
  for (std::size_t k = 0; k < n; ++k) keys[k] = static_cast<std::uint32_t>(random.bits(k) >> (64 - bits));
  return keys;
}

order by_the_standard_library(const order& keys) {
  order o(keys.size());
  std::iota(o.begin(), o.end(), 0u);
  std::ranges::stable_sort(o, {}, [&](std::uint32_t i) { return keys[i]; });
  return o;
}

order sorted(counting_sort& s, const order& keys, int bits, const team& t) {
  s.sort(keys, bits, t);
  return {s.order().begin(), s.order().end()};
}

class counting_sort_test : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(size, counting_sort_test, testing::Values(0, 1, 2, 1000, 100000));

TEST_P(counting_sort_test, equals_stable_sort_for_every_team) {
  counting_sort s;  // one object for all: what it keeps from call to call must not matter
  for (int bits = 1; bits <= 32; bits += GetParam() > 1000 ? 3 : 1) {
    const order keys = random_keys(GetParam(), bits, 7u + static_cast<unsigned>(bits));
    const order expected = by_the_standard_library(keys);
    ASSERT_EQ(sorted(s, keys, bits, team()), expected) << bits << " bits, serial";
    for (const runtime kind : {runtime::omp, runtime::tbb})
      for (const int threads : {1, 2, 3, 7}) {
        test_kit::workers w(kind, threads);
        ASSERT_EQ(sorted(s, keys, bits, w.get()), expected) << bits << " bits, " << name_of(kind) << " " << threads;
      }
  }
}

TEST(counting_sort, extreme_keys) {
  counting_sort s;
  for (const int bits : {1, 11, 12, 22, 23, 30, 31, 32}) {
    const std::uint32_t last = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
    const order keys{last, 0, last, 1, 0, last - 1, last};
    EXPECT_EQ(sorted(s, keys, bits, team::omp(3)), by_the_standard_library(keys)) << bits << " bits";
  }
}

TEST(counting_sort, order_of_equal_keys_is_kept) {
  counting_sort s;
  EXPECT_EQ(sorted(s, {5, 5, 1, 5, 1}, 3, team::omp(2)), (order{2, 4, 0, 1, 3}));
}

TEST(reorderer, moves_every_column_of_every_width_and_leaves_the_rest) {
  for (const int threads : {1, 2, 3, 7}) {
    particle_set<3, double> p;
    p.resize(6);
    p.carry(2);
    for (std::uint32_t i = 0; i < 6; ++i) {
      for (int d = 0; d < 3; ++d) p.x[d][i] = 10 * d + i, p.v[d][i] = -(10 * d + 1.0 * i);
      p.rho[i] = 100 + i;
      p.m[i] = 200 + i;
      p.id[i] = i;
      p.carried[0][i] = 300 + i;
      p.carried[1][i] = 400 + i;
      p.kind[i] = i < 3 ? particle_kind::fluid : particle_kind::boundary;
    }
    reorderer r;
    r.apply(p, order{3, 0, 2, 1}, team::omp(threads));
    const order expected{3, 0, 2, 1, 4, 5};
    for (std::size_t k = 0; k < 6; ++k) {
      const std::uint32_t i = expected[k];
      EXPECT_EQ(p.id[k], i);
      for (int d = 0; d < 3; ++d) {
        EXPECT_EQ(p.x[d][k], 10 * d + i);
        EXPECT_EQ(p.v[d][k], -(10 * d + 1.0 * i));
      }
      EXPECT_EQ(p.rho[k], 100 + i);
      EXPECT_EQ(p.m[k], 200 + i);
      EXPECT_EQ(p.carried[0][k], 300 + i);
      EXPECT_EQ(p.carried[1][k], 400 + i);
      EXPECT_EQ(p.kind[k], i < 3 ? particle_kind::fluid : particle_kind::boundary);
    }
  }
}

}  // namespace
}  // namespace pairsum

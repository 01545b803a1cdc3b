#include <pairsum/schedule/slabs.hpp>

#include <gtest/gtest.h>

#include <set>

#include <pairsum/core/random.hpp>
#include "layers_at.hpp"

// Slabs of layers, one for each thread: who writes to a layer that another slab writes to holds a lock for it.
namespace pairsum {
namespace {

using namespace test_kit;
using layer_set = std::set<std::int64_t>;

/// The layers with fluid that the sweep of cells [begin, end) writes to.
layer_set written(const std::vector<cell_layer>& layers, std::int64_t around, std::uint32_t begin, std::uint32_t end) {
  layer_set all, fluid;
  for (const cell_layer& layer : layers) {
    fluid.insert(layer.at);
    if (layer.begin >= begin && layer.end <= end) all.insert({layer.at, layer_after(layer.at, around)});
  }
  std::erase_if(all, [&](std::int64_t at) { return !fluid.contains(at); });
  return all;
}

bool meet(const layer_set& a, const layer_set& b) {
  return std::ranges::any_of(a, [&](std::int64_t at) { return b.contains(at); });
}

bool exclude_each_other(const stretch& a, const stretch& b) {
  const auto holds = [](const stretch& s, std::int32_t lock) { return lock >= 0 && (s.low == lock || s.high == lock); };
  return holds(b, a.low) || holds(b, a.high);
}

/// Pairs of stretches of two slabs that write to a common layer and may do so at the same time.
int races(const std::vector<slab>& slabs, const std::vector<cell_layer>& layers, std::int64_t around) {
  int n = 0;
  for (std::size_t s = 0; s < slabs.size(); ++s)
    for (std::size_t t = s + 1; t < slabs.size(); ++t)
      for (const stretch& a : slabs[s])
        for (const stretch& b : slabs[t])
          n += meet(written(layers, around, a.begin, a.end), written(layers, around, b.begin, b.end)) &&
               !exclude_each_other(a, b);
  return n;
}

std::vector<std::uint64_t> random_work(std::size_t n, std::uint64_t seed) {
  const counter_random random(seed);
  std::vector<std::uint64_t> work(n);
  for (std::size_t k = 0; k < n; ++k) work[k] = random.bits(k) % 20;
  return work;
}

class rings_test : public testing::TestWithParam<int> {};  // layers around; 0: an open grid of 9
INSTANTIATE_TEST_SUITE_P(layers, rings_test, testing::Values(0, 3, 4, 6, 8, 10));

/// Every set of layers with fluid, every number of threads.
TEST_P(rings_test, locks_exclude_what_would_race_and_every_one_is_needed) {
  const int around = GetParam(), n = around > 0 ? around : 9;
  int with_locks = 0;
  for (std::uint32_t mask = 0; mask < 1u << n; ++mask) {
    const auto layers = layers_at(mask);
    const auto work = random_work(layers.size(), mask);
    for (std::size_t most = 1; most <= static_cast<std::size_t>(n) + 2; ++most) {
      std::vector<slab> slabs = cut_slabs(layers, work, around, most);
      ASSERT_LE(slabs.size(), std::min(most, layers.size()));
      ASSERT_EQ(races(slabs, layers, around), 0) << "mask " << mask << ", " << most << " slabs";
      std::uint32_t next = 1;
      for (std::size_t k = 0; k < slabs.size(); ++k)
        for (stretch& s : slabs[k]) {
          if (s.begin == s.end) continue;
          ASSERT_EQ(s.begin, next) << "cells in order, each once";
          next = s.end;
          ASSERT_TRUE(s.high == -1 || s.low < s.high) << "taken in ascending order";
          ASSERT_LT(std::max(s.low, s.high), static_cast<std::int32_t>(slabs.size()));
          for (std::int32_t* const lock : {&s.low, &s.high}) {
            if (*lock < 0) continue;
            const std::int32_t was = std::exchange(*lock, -1);
            ASSERT_GT(races(slabs, layers, around), 0) << "without lock " << was << " of slab " << k;
            *lock = was;
            ++with_locks;
          }
        }
      ASSERT_EQ(next, layers.size() + 1);
    }
  }
  EXPECT_GT(with_locks, around == 3 ? 40 : 100);
}

TEST(slabs, one_takes_no_lock_and_gaps_need_none) {
  const auto locks = [](std::uint32_t mask, std::int64_t around, std::size_t most) {
    const auto layers = layers_at(mask);
    int n = 0;
    for (const slab& s : cut_slabs(layers, std::vector<std::uint64_t>(layers.size(), 1), around, most))
      for (const stretch& k : s) n += (k.low >= 0) + (k.high >= 0);
    return n;
  };
  EXPECT_EQ(locks(0b1111, 4, 1), 0);
  EXPECT_EQ(locks(0b1111, 4, 2), 4) << "two interfaces, two sides each";
  EXPECT_EQ(locks(0b1111, 4, 9), 8) << "four slabs of one layer";
  EXPECT_EQ(locks(0b1111, 0, 9), 6);
  EXPECT_EQ(locks(0b0101, 4, 2), 0);
  EXPECT_EQ(locks(0b1001, 4, 2), 2) << "round the ring";
  EXPECT_EQ(locks(0b1001, 0, 2), 0);
  EXPECT_EQ(locks(0, 4, 3), 0);
}

/// The least possible largest piece, by trying all.
std::uint64_t least_largest(const std::vector<std::uint64_t>& work, std::size_t begin, std::size_t most) {
  std::uint64_t sum = 0, best = ~std::uint64_t{0};
  if (begin == work.size()) return 0;
  if (most == 0) return best;
  for (std::size_t end = begin; end < work.size(); ++end) {
    sum += std::max<std::uint64_t>(work[end], 1);
    best = std::min(best, std::max(sum, least_largest(work, end + 1, most - 1)));
  }
  return best;
}

TEST(slabs, work_is_cut_as_evenly_as_can_be) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto work = random_work(seed % 9, seed);
    for (std::size_t most = 1; most < 12; ++most) {
      const auto cuts = cut_evenly(work, most);
      ASSERT_EQ(cuts.front(), 0u);
      ASSERT_EQ(cuts.back(), work.size());
      ASSERT_LE(cuts.size(), most + 1);
      std::uint64_t largest = 0;
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        ASSERT_LT(cuts[k], cuts[k + 1]) << "none is empty";
        std::uint64_t sum = 0;
        for (std::size_t i = cuts[k]; i < cuts[k + 1]; ++i) sum += std::max<std::uint64_t>(work[i], 1);
        largest = std::max(largest, sum);
      }
      EXPECT_EQ(largest, least_largest(work, 0, most)) << seed << " in " << most;
    }
  }
}

}  // namespace
}  // namespace pairsum

#include "harness/model/link.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene.hpp"

namespace pairsum::harness {
namespace {

using test_kit::error_of;
using test_kit::says;

/// Times there and back over a link; every third repetition was disturbed.
bounce_times over(const link_rates& link, std::size_t bytes) {
  bounce_times t{bytes, {}};
  for (int k = 0; k < 9; ++k) {
    const double one_way = link.latency_s + static_cast<double>(bytes) / link.bandwidth_bytes_per_s;
    t.seconds.push_back(2 * one_way * (k % 3 == 2 ? 50 : 1));
  }
  return t;
}

TEST(link, fit_finds_the_rates_that_made_the_times) {
  for (const link_rates& made : {link_rates{1e-6, 1e10}, link_rates{5e-5, 1e8}, link_rates{2e-7, 4e11}}) {
    const link_rates r = fit_link(over(made, 8), over(made, 1 << 22));
    EXPECT_NEAR(r.latency_s, made.latency_s, 1e-9 * made.latency_s);
    EXPECT_NEAR(r.bandwidth_bytes_per_s, made.bandwidth_bytes_per_s, 1e-9 * made.bandwidth_bytes_per_s);
  }
}

TEST(link, refuses_times_that_are_no_link) {
  const link_rates made{1e-6, 1e10};
  const bounce_times small = over(made, 8), large = over(made, 1 << 22);
  const auto refusal = [](const bounce_times& s, const bounce_times& l) { return error_of([&] { fit_link(s, l); }); };
  EXPECT_EQ(refusal(small, large), "");
  EXPECT_TRUE(says(refusal({8, {}}, large), {"8 bytes", "not timed"}));
  EXPECT_TRUE(says(refusal(small, {4096, {}}), {"4096 bytes", "not timed"}));
  for (const double wrong : {0.0, -1e-6, std::nan(""), HUGE_VAL}) {
    bounce_times broken = large;
    broken.seconds[4] = wrong;
    EXPECT_TRUE(says(refusal(small, broken), {"positive and finite"}));
  }
  EXPECT_TRUE(says(refusal(large, small), {"a large message and a small one", "not 8 bytes and 4194304"}));
  EXPECT_TRUE(says(refusal(small, {4096, small.seconds}), {"no bandwidth", "longer"}));
  EXPECT_TRUE(says(refusal(over(made, 4096), {8192, std::vector<double>(3, 1e-4)}), {"no latency", "smaller"}));
}

TEST(link, every_rank_bounces_as_often) {
  const link_limits limits{
      .small_bytes = 1, .large_bytes = 1 << 20, .small_repetitions = 5, .large_repetitions = 3, .warm_up = 1};
  for (const bool timed : {true, false}) {
    std::vector<std::size_t> sizes;
    const auto bounce = [&](std::span<std::byte> m) {
      sizes.push_back(m.size());
      // 10000 steps of latency and one for each byte: the fit refuses neither.
      volatile double x = 1;
      for (std::size_t k = 0; k < 10000 + m.size(); ++k) x = x * 0.5 + 1;
    };
    const link_rates r = measure_link(bounce, timed, limits);
    EXPECT_EQ(sizes.size(), 10u);
    EXPECT_EQ(std::ranges::count(sizes, limits.small_bytes), 6);
    EXPECT_EQ(std::ranges::count(sizes, limits.large_bytes), 4);
    EXPECT_EQ(r.bandwidth_bytes_per_s > 0, timed);
  }
  const bounce_times t = time_bounces([](std::span<std::byte>) {}, 16, 4, 2);
  EXPECT_EQ(t.bytes, 16u);
  EXPECT_EQ(t.seconds.size(), 4u) << "without those of the warm-up";
}

}  // namespace
}  // namespace pairsum::harness

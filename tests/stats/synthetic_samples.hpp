#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "harness/stats/interval.hpp"

/// Samples whose truth is known, and how often an interval holds it.
namespace pairsum::harness::synthetic {

using values = std::vector<double>;
using generator = std::mt19937_64;
inline constexpr int draws = 2000;
inline constexpr std::size_t sizes[] = {6, 10, 20};

/// Four standard deviations of a share `p` counted over `count` draws: chance alone passes it once in 16000 checks.
inline double tolerance(double p, int count = draws) { return 4 * std::sqrt(p * (1 - p) / count); }

inline bool holds(const std::optional<interval>& bounds, double truth) {
  return bounds && bounds->low <= truth && truth <= bounds->high;
}

/// Leaves the figure in the test's XML report.
inline void record(const std::string& what, std::size_t n, double share) {
  testing::Test::RecordProperty(what + "_" + std::to_string(n), std::to_string(share));
}

/// Calls `holds(random)`, does the interval of a fresh sample hold the truth?, `draws` times; returns the share.
template <class F>
double coverage(unsigned seed, F&& holds) {
  generator random(seed);
  int covered = 0;
  for (int draw = 0; draw < draws; ++draw) covered += holds(random);
  return static_cast<double>(covered) / draws;
}

/// Disturbances of a time: of the factor's logarithm unless said.
inline double normal_noise(generator& random) { return std::log1p(0.1 * std::normal_distribution<>()(random)); }
inline double log_normal_noise(generator& random) { return 0.5 * std::normal_distribution<>()(random); }
inline double heavy_noise(generator& random) { return 0.05 * std::student_t_distribution<>(2)(random); }
/// What only ever delays: a right tail and none to the left.
inline double delays(generator& random) { return std::log1p(0.2 * std::exponential_distribution<>()(random)); }

struct pair_of_samples {
  values base, other;
};

/// Times of two backends in n rounds: `ratio` and 1 times exp(noise), each with noise of its own; besides, both are
/// multiplied by a factor that walks at random from round to round by `drift`.
template <class Noise>
pair_of_samples rounds(std::size_t n, double ratio, Noise&& noise, generator& random, double drift = 0) {
  pair_of_samples s;
  double common = 0;
  for (std::size_t i = 0; i < n; ++i) {
    common += drift * std::normal_distribution<>()(random);
    s.base.push_back(ratio * std::exp(common + noise(random)));
    s.other.push_back(std::exp(common + noise(random)));
  }
  return s;
}

}  // namespace pairsum::harness::synthetic

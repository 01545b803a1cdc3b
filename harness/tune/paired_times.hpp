#pragma once
#include <cmath>
#include <vector>

#include "harness/stats/ratio.hpp"
#include "harness/tune/contest.hpp"

namespace pairsum::harness {

/// The geometric mean of a candidate's rounds; it must have one.
inline double typical_time(const contestant& c) {
  double sum = 0;
  for (const auto& [round, seconds] : c.times) sum += std::log(seconds);
  return std::exp(sum / static_cast<double>(c.times.size()));
}

/// The time of a candidate over that of another, paired by the rounds that both have; with 0 pairs, and a value of 0,
/// if there is none.
inline ratio_estimate ratio_to(const contestant& own, const contestant& other, double level = 0.95) {
  std::vector<double> own_times, other_times;
  for (const auto& [round, seconds] : own.times)
    if (const auto match = other.times.find(round); match != other.times.end()) {
      own_times.push_back(seconds);
      other_times.push_back(match->second);
    }
  return own_times.empty() ? ratio_estimate{} : paired_ratio(own_times, other_times, level);
}

}  // namespace pairsum::harness

#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// How many threads of a team had work: those that were busy for at least 1 % of the time of the busiest, over all
/// passes. A thread that finds no work left in a pass is busy, too, for a moment.
/// @param busy_s seconds by [pass][thread]
inline std::uint64_t threads_worked(const thread_times& busy_s) {
  constexpr double least_share = 0.01;
  std::vector<double> busy;
  for (const std::vector<double>& pass : busy_s) {
    busy.resize(std::max(busy.size(), pass.size()));
    for (std::size_t k = 0; k < pass.size(); ++k) busy[k] += pass[k];
  }
  const double most = busy.empty() ? 0 : *std::ranges::max_element(busy);
  return static_cast<std::uint64_t>(
      std::ranges::count_if(busy, [&](double s) { return s > 0 && s >= least_share * most; }));
}

}  // namespace pairsum::harness

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "harness/stats/moments.hpp"

namespace pairsum::harness {

/// Scatter of a measured time, as standard deviations relative to its mean.
struct variance_components {
  std::optional<double> between;  ///< of the processes' own means; empty with one process
  std::optional<double> within;   ///< of the repetitions inside a process; empty if no process has two
};

/// The components of variance of one-way data, groups[process][repetition], of model y_ij = mean + a_i + e_ij with
/// random a_i: the method of moments for unbalanced groups (Searle, Casella, McCulloch, Variance Components, 1992, sec.
/// 3.6). A negative estimate of a variance is reported as 0. The mean is that of the groups' means. If no group has two
/// values the two cannot be told apart: `between` then holds their sum.
/// Throws pairsum::error if there is no group, one is empty, or a value is not positive and finite.
inline variance_components components_of_variance(std::span<const std::vector<double>> groups) {
  std::vector<double> means;
  double count = 0, squared_sizes = 0, inside = 0, sum = 0;
  for (const std::vector<double>& group : groups) {
    for (const double value : group)
      if (!(value > 0)) throw error("a relative standard deviation needs positive values");
    const double size = static_cast<double>(group.size());
    means.push_back(mean(group));
    inside += squared_deviations(group);
    count += size;
    squared_sizes += size * size;
    sum += size * means.back();
  }
  const double centre = mean(means);
  const double processes = static_cast<double>(means.size());
  variance_components found;
  double within = 0;  // mean square within groups
  if (count > processes) {
    within = inside / (count - processes);
    found.within = std::sqrt(within) / centre;
  }
  if (groups.size() < 2) return found;
  double outside = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const double off = means[i] - sum / count;
    outside += static_cast<double>(groups[i].size()) * off * off;
  }
  const double mean_square = outside / (processes - 1);
  const double typical_size = (count - squared_sizes / count) / (processes - 1);
  found.between = std::sqrt(std::max(0.0, (mean_square - within) / typical_size)) / centre;
  return found;
}

}  // namespace pairsum::harness

#include "harness/tune/winner.hpp"

#include <vector>

#include "harness/stats/median.hpp"

namespace pairsum::harness {

tuned_time time_of(const tune_result& result) {
  const contestant& best = result.candidates.at(result.winner.value());
  std::vector<double> times;
  for (const auto& [round, seconds] : best.times) times.push_back(seconds);
  if (times.empty()) return {*best.look_s, std::nullopt, 0};
  return {median(times), median_interval(times), times.size()};
}

}  // namespace pairsum::harness

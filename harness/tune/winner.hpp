#pragma once
#include <cstddef>
#include <optional>

#include "harness/stats/interval.hpp"
#include "harness/tune/tune.hpp"

namespace pairsum::harness {

/// How long the winner takes: the median over its rounds, with an interval if they are enough; without a round its
/// look.
struct tuned_time {
  double seconds = 0;
  std::optional<interval> bounds;
  std::size_t rounds = 0;
};

/// Of a result that has a winner.
tuned_time time_of(const tune_result& result);

}  // namespace pairsum::harness

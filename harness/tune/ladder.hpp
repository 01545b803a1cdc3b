#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/stats/ratio.hpp"
#include "harness/tune/tune.hpp"

namespace pairsum::harness {

/// What a candidate is against the winner.
enum class standing_of { slower, faster, not_resolved, set_aside };

/// "slower", "faster", "not resolved", "set aside": by its looks, before there were rounds.
std::string_view word_of(standing_of s);

/// A line of the ladder.
struct rung {
  std::size_t candidate;
  ratio_estimate ratio;  ///< its time over the winner's; without pairs that of the looks
  standing_of verdict;   ///< at 95 % over the whole ladder
};

/// What was timed beside the winner, the fastest first. Of a result that has a winner.
std::vector<rung> ladder_of(const tune_result& result);

}  // namespace pairsum::harness

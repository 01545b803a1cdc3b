#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "harness/measure/binding.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/ranks/placement.hpp"
#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// What the ranks of a job did in a step, as it grows with the evaluations of that. Nothing where there is one rank.
class step_of_ranks {
 public:
  step_of_ranks(const std::vector<rank_seat>& seats, const placement& places, int threads);

  /// After an evaluation, of which this rank's sum took so long and then waited for the others.
  void add(summation& s, double busy_s, double waiting_s);

  /// The ranks of the step, and its phases, which become the largest of all ranks.
  std::optional<std::vector<rank_row>> end(phases& times);

  double waiting_s() const { return waiting_s_; }

 private:
  std::vector<rank_row> ranks_;
  double busy_s_ = 0, waiting_s_ = 0;
};

/// The largest of all ranks; none where a rank has none.
std::optional<std::uint64_t> largest_of_ranks(const std::optional<std::uint64_t>& own);
/// The sum over all ranks; none where a rank has none.
std::optional<std::uint64_t> sum_of_ranks(const std::optional<std::uint64_t>& own);
std::optional<counters_row> sum_of_ranks(const std::optional<counters_row>& own);

}  // namespace pairsum::harness

#pragma once
#include <optional>
#include <string>
#include <vector>

#include "harness/plan/plan.hpp"
#include "harness/tune/contest.hpp"

namespace pairsum::harness {

/// What `pairsum tune` is asked.
struct tune_request {
  run_request levels;           ///< one case; backends, grids, M, isas, blocks, precisions, threads and granularities
  bool all_M = true;            ///< false: of levels.M those are left out that do not go round a periodic box
  double budget_s = 60;         ///< for everything
  std::string phase = "total";  ///< "total": index, prepare, zero, sum and reduce; "sum" alone
  std::string binding = "cores_first";
  contest_rules rules;
};

/// What it found. A candidate's point and what became of it stand at the same place of the two lists.
struct tune_result {
  std::vector<point> points;  ///< with the particle numbers
  std::vector<contestant> candidates;
  std::optional<std::size_t> winner;
  bool interrupted = false;
  double prepared_s = 0;               ///< until the first candidate was measured: particles and reference
  std::optional<double> others_share;  ///< of the machine's CPU time, used by other processes meanwhile
};

/// Looks for the fastest candidate by contend(). Each measurement makes a new summation, loads the particles, evaluates
/// once untimed and then timed, for at least some milliseconds; all rates are verified before their time counts.
/// Throws pairsum::error for a request that makes no sense, and if the budget ends before anything was measured.
tune_result tune(const tune_request& r, const registry& all);

}  // namespace pairsum::harness

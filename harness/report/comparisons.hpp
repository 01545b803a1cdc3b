#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/report/measured.hpp"

/// The comparisons between points of a series, as the arrays of summary.json (docs/design.md,
/// section 4). Times are those of the summation phase. Two points are paired inside the same file,
/// round and repetition; points that share none are compared unpaired, with a caveat.
namespace pairsum::harness {

/// Every point against itself on one thread; a missing base leaves the entry out with a caveat.
nlohmann::json thread_speedups(const measurements& all, std::vector<std::string>& caveats);

/// naive at every M against symmetric at M=6, for each runtime and number of threads.
nlohmann::json algorithm_speedups(const measurements& all, std::vector<std::string>& caveats);

/// The OpenMP version of every algorithm against its TBB version.
nlohmann::json runtime_comparisons(const measurements& all, std::vector<std::string>& caveats);

/// Time and work of every point, to be read over M.
nlohmann::json m_comparisons(const measurements& all);

/// Pairs that interact per distance test; null if the work was not counted or nothing was tested.
nlohmann::json useful_pair_ratio(const measured_point& point);

}  // namespace pairsum::harness

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/report/measured.hpp"

/// The comparisons between points of a series, as the arrays of summary.json (docs/design.md, section 4). Times are
/// those of the summation phase. Two points are paired inside the rounds that both were measured in; points that share
/// none are compared unpaired, with a caveat. The comparisons of a table are judged together (Holm). Where a backend
/// was measured with several granularities, algorithms and runtimes are compared each with its fastest.
namespace pairsum::harness {

/// Every point against itself on one thread; a missing base leaves the entry out with a caveat.
nlohmann::json thread_speedups(const measurements& all, std::vector<std::string>& caveats);

/// naive against symmetric at the same M, and naive at M=7 against symmetric at M=6, for each runtime and number of
/// threads.
nlohmann::json algorithm_speedups(const measurements& all, std::vector<std::string>& caveats);

/// The OpenMP version of every algorithm against its TBB version.
nlohmann::json runtime_comparisons(const measurements& all, std::vector<std::string>& caveats);

/// Every point of the first build against the same of the others, if builds are what the study compares.
nlohmann::json compiler_comparisons(const measurements& all, std::vector<std::string>& caveats);

/// Time and work of every point, to be read over M, and whether its step is slower than with the best M.
nlohmann::json m_comparisons(const measurements& all, std::vector<std::string>& caveats);

/// Pairs that interact per distance test; null if the work was not counted or nothing was tested.
nlohmann::json useful_pair_ratio(const measured_point& point);

}  // namespace pairsum::harness

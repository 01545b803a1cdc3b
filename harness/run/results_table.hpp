#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "harness/run/ranking.hpp"

namespace pairsum::harness {

/// What a run shows at its end: per problem a table, the fastest point first, and below it in words how much faster
/// that is, and what could not be told from it. A table has a column for every level that differs somewhere; the others
/// are said above it. Times are medians over rounds of the mean step, with their intervals.
/// @param most_rows of all tables together; what was measured beyond is counted, what failed is always shown
/// @param colours of a terminal
std::string results_table(const std::vector<ranking>& all, bool colours = false, std::size_t most_rows = 30);

/// A line that says how many rounds other processes disturbed and how many were void; empty if none.
/// @param rounds finished ones
std::string disturbance_text(const std::vector<round_row>& rounds, std::size_t voids);

/// Has every point that did not fail the rounds for an interval of its median?
bool has_intervals(const std::vector<ranking>& all);

}  // namespace pairsum::harness

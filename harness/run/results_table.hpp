#pragma once
#include <string>
#include <vector>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// The table at the end of a run: per point the medians over repetitions of the mean step, and the cost of the sum per
/// interacting pair; of a point that failed its verification, why.
std::string results_table(const std::vector<sample>& samples);

}  // namespace pairsum::harness

#pragma once
#include <string>
#include <vector>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// The table at the end of a run: per point the medians over repetitions of the mean step, the cost per interacting pair, and how it
/// was verified. `failed` are error rows.
std::string results_table(const std::vector<sample>& samples);

}  // namespace pairsum::harness

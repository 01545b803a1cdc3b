#pragma once
#include <string>
#include <vector>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// What a table leaves out of a point: "dam_break 3D, H = 2 dx, double, ferrari09, wendland_c2, euler, order lattice".
std::string words_of(const point& p);

/// The table at the end of a run: per point the medians over rounds of the mean step, and the cost of the sum per
/// interacting pair; of a point that failed its verification, why. Points that differ in words_of are set apart under
/// headings.
std::string results_table(const std::vector<sample>& samples);

}  // namespace pairsum::harness

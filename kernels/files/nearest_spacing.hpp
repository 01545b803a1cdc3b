#pragma once
#include <span>
#include <vector>

namespace pairsum::files {

/// The median distance to the nearest other point, of at most 400 points evenly among them; 0 for fewer than two
/// places. Columns of equal length, m.
double nearest_spacing(std::span<const std::vector<double>* const> x);

}  // namespace pairsum::files

#pragma once

#include <nlohmann/json_fwd.hpp>

#include "harness/report/measured.hpp"

namespace pairsum::harness {

/// What the point's summation must cost at least by the model (docs/model.md), against the peaks measured with the same
/// threads, precision and binding, and how near the measured time is; null if the work or the peaks are not known, or
/// this build does not have the formula.
nlohmann::json model_entry(const measurements& all, const measured_point& p);

}  // namespace pairsum::harness

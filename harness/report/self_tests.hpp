#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/report/measured.hpp"

namespace pairsum::harness {

/// What the harness says of backends whose behaviour is known (harness/self_test): a copy should not be resolved from
/// its base or lie within the interval, a calibrated delay should lie within it, a corrupt backend should have no time.
/// Intervals are at 95 % over all ratios of the table together (Bonferroni). Reported as found.
nlohmann::json self_tests(const measurements& all, std::vector<std::string>& caveats);

/// Is the backend one of them?
bool is_self_test(const std::string& backend);

/// The backend that does the work: of such a copy its base, else the backend itself.
std::string working_backend(const std::string& backend);

}  // namespace pairsum::harness

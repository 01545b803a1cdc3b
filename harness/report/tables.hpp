#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace pairsum::harness {

/// All tables of a summary as text of at most 120 columns (longer only if names are): per series
/// the summation times, algorithm speedups, OpenMP against TBB, the comparison over M and the
/// phases; then the failed points and the caveats. Every table has a line above it that says what
/// it shows.
std::string print_tables(const nlohmann::json& summary);

}  // namespace pairsum::harness

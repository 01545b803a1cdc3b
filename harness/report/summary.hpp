#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "harness/report/measured.hpp"

namespace pairsum::harness {

inline constexpr const char* summary_schema = "pairsum.summary/2";

/// The summary of docs/design.md, section 4.
nlohmann::json build_summary(const measurements& all);

/// Reads nothing but the given rows: collect(files, allow_mixed), then build_summary. Throws like
/// collect.
nlohmann::json build_summary(const std::vector<rows_file>& files, bool allow_mixed = false);

}  // namespace pairsum::harness

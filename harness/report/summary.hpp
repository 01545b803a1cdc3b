#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "harness/report/measured.hpp"

namespace pairsum::harness {

inline constexpr const char* summary_schema = "pairsum.summary/1";

/// The summary of docs/design.md, section 4. Beyond the keys listed there it has `series` (the
/// problems; points and comparisons name theirs by index), `runtime_comparison` (OpenMP against
/// TBB) and `failed`.
nlohmann::json build_summary(const measurements& all);

/// Reads nothing but the given rows: collect(files, allow_mixed), then build_summary. Throws like
/// collect.
nlohmann::json build_summary(const std::vector<rows_file>& files, bool allow_mixed = false);

/// Writes the summary to a temporary file beside `path`, then renames it: there is the old file or
/// the new one, never a part. Creates the folders above. Throws pairsum::error with one line if it
/// cannot.
void write_summary(const nlohmann::json& summary, const std::filesystem::path& path);

}  // namespace pairsum::harness

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace pairsum::harness {

/// The answer and the questions in words, then all tables of a summary as text of at most 120 columns (longer only if
/// names are): per series the summation times, algorithm speedups, OpenMP against TBB, the comparison over M, the
/// bounds, the phases and the builds; then the self-test, the failed points and the caveats. Every table has a line
/// above it that says what it shows.
std::string print_tables(const nlohmann::json& summary);

/// The same as Markdown.
std::string print_markdown(const nlohmann::json& summary);

/// An array of objects of the summary as comma-separated values, quoted as in RFC 4180 (lines end in \n): a column per
/// key, nested keys joined with points; lists are left out, null is an empty cell.
std::string print_csv(const nlohmann::json& entries);

}  // namespace pairsum::harness

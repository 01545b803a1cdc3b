#pragma once
#include <filesystem>
#include <string>

#include "harness/plan/plan.hpp"

namespace pairsum::harness {

/// Where rows go if the user does not say: <results>/<study>/<host>-<utc>-<git>.jsonl.
std::filesystem::path default_rows_path(const std::filesystem::path& results, const std::string& study);

/// Measures the request and appends its rows to `out`: per world first a warm-up of every point, in which every step is
/// verified and nothing timed is kept, then repetitions in seeded, recorded, interleaved order, until the wanted number
/// is reached or the budget would be exceeded (one repetition is always made). Prints a table to stdout. SIGINT ends
/// the run after the step or the reference under way (a second SIGINT at once); rows written are valid. Returns the
/// exit code: 0, 1 if a point failed its verification, 130 after SIGINT.
int run(const run_request& r, const std::filesystem::path& out, const registry& all = registry::instance());

}  // namespace pairsum::harness

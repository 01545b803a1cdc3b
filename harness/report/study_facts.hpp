#pragma once

#include <string>

#include "harness/report/measured.hpp"

/// What a report says of the study as a whole.
namespace pairsum::harness {

/// Keeps the best of what was measured for the same environment, threads and precision.
void add_peak(measurements& all, const peak_row& p);

/// Adds the paces of a file's finished rounds, and raises the peaks that turned out to be too low. Call when all builds
/// are known.
void add_paces(measurements& all, const rows_file& rows, std::size_t file);

/// Counts a file's rounds, with a caveat if other processes disturbed some.
void add_rounds(measurements& all, const rows_file& file);

/// Caveats on what the rows were measured with; `differences` of the builds, empty if there are none.
void add_environment_caveats(measurements& all, const std::string& differences);

}  // namespace pairsum::harness

#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// Describes this machine and this build. The id (`environment`) is a hash of everything but the time and the study, so
/// equal conditions have equal ids.
/// `binding` and `counters` say how threads are pinned and what the hardware counts.
environment_row describe_environment(const std::string& study, const std::string& binding = "none",
                                     const std::string& counters = "none: not asked for");

/// Machine, build and time for a document that is no rows file: an environment row without what is a study's.
nlohmann::json provenance();

/// Version, revision, compiler and flags of this build, for --version.
std::string describe_build();

/// The instruction set the library was compiled for: "avx512", "avx2", "sse2", "neon" or "generic".
std::string compiled_isa();

/// Now, UTC, with milliseconds: 2026-11-22T15:30:00.123Z.
std::string utc_now();
/// The same to the second without separators, for file names: 20261122T153000Z.
std::string utc_stamp();

}  // namespace pairsum::harness

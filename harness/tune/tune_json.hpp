#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "harness/tune/tune.hpp"

namespace pairsum::harness {

inline constexpr const char* tune_schema = "pairsum.tune/1";

/// What tune() found, as a document (tune.schema.json): the winner, and every candidate with what became of it.
/// @param profile the file that holds the winner's profile; empty if none was written
nlohmann::json tune_json(const tune_request& r, const tune_result& result, const registry& all,
                         const std::string& profile);

}  // namespace pairsum::harness

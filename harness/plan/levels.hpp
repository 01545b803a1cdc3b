#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/plan/plan.hpp"

namespace pairsum::harness {

/// Sets the levels of one factor (or one number, like "steps") of a request from JSON: a number, a text as on the
/// command line ("5..9", "all"), or a list of them. Returns false if there is no such key; throws pairsum::error naming
/// the key if the value is wrong.
/// @param cores what "all" and "cores" mean for threads
/// @param called what messages call the key; empty: the plan's "key"
bool read_level(run_request& r, const std::string& key, const nlohmann::json& value, int cores,
                const std::string& called = "");

/// The same levels as JSON.
nlohmann::json levels_json(const run_request& r);

/// The keys.
std::vector<std::string> level_words();

}  // namespace pairsum::harness

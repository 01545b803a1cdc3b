#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
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

/// A word for what particle files do not say: a level of a request, and an option with - for _.
struct particle_hint {
  std::string_view word, what;
};
const std::vector<particle_hint>& particle_hints();

/// The option of a level: "--h-quantile" of h_quantile.
std::string option_of(std::string_view level);

}  // namespace pairsum::harness

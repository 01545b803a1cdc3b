#pragma once
#include <map>
#include <string>
#include <vector>

#include "harness/plan/plan.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace pairsum::harness {

/// What was given beside the defaults, by option name without dashes.
using given_options = std::map<std::string, bool>;
given_options given_of(const CLI::App& command);

/// Adds an option for each of particle_hints(); their texts go to `levels`, by level.
void add_particle_hints(CLI::App& command, std::map<std::string, std::string>& levels);

/// Adds --particles, which is returned, and the same options, which help does not show.
CLI::Option* add_particle_options(CLI::App& command, std::map<std::string, std::string>& levels);

/// The levels that options name; where a profile is named, its levels instead of those that were not given.
/// @param profile a file of pairsum tune; empty: none
run_request levels_of(const std::map<std::string, std::string>& options, const std::string& profile,
                      const given_options& given);

}  // namespace pairsum::harness

#include "harness/cli/profile_levels.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "harness/environment/machine.hpp"
#include "harness/plan/levels.hpp"
#include "harness/tune/profile_json.hpp"

namespace pairsum::harness {

given_options given_of(const CLI::App& command) {
  given_options given;
  for (const CLI::Option* option : command.get_options()) given[option->get_single_name()] = option->count() > 0;
  return given;
}

run_request levels_of(const std::map<std::string, std::string>& options, const std::string& profile,
                      const given_options& given) {
  run_request r;
  if (!profile.empty()) {
    const saved_profile p = read_profile(profile);
    if (const std::string text = differences(p); !text.empty()) fmt::print("note: {}\n", text);
    r = p.levels;
  }
  for (const auto& [key, text] : options)
    if (profile.empty() || given.at(key) || !profile_says(key)) read_level(r, key, text, usable_cores(), "--" + key);
  return r;
}

}  // namespace pairsum::harness

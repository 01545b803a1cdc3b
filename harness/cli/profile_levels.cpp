#include "harness/cli/profile_levels.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include "harness/environment/machine.hpp"
#include "harness/plan/levels.hpp"
#include "harness/tune/profile_json.hpp"

namespace pairsum::harness {

given_options given_of(const CLI::App& command) {
  given_options given;
  for (const CLI::Option* option : command.get_options()) given[option->get_single_name()] = option->count() > 0;
  return given;
}

void add_particle_hints(CLI::App& command, std::map<std::string, std::string>& levels) {
  for (const particle_hint& h : particle_hints())
    if (h.word != "file_dim")  // which --dim says
      command.add_option(option_of(h.word), levels[std::string(h.word)], std::string(h.what));
}

CLI::Option* add_particle_options(CLI::App& command, std::map<std::string, std::string>& levels) {
  CLI::Option* const files = command.add_option(
      "--particles", levels["particles"], "files of particles in place of a case; what they lack: pairsum info --help");
  add_particle_hints(command, levels);
  for (const particle_hint& h : particle_hints())
    if (h.word != "file_dim") command.get_option(option_of(h.word))->group("");  // help stays on a screen
  return files;
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
    if (const bool told = given.contains(option_of(key).substr(2)) && given.at(option_of(key).substr(2));
        told || (!text.empty() && (profile.empty() || !profile_says(key))))
      read_level(r, key, text, usable_cores(), option_of(key));
  if (r.particles.empty()) return r;
  // The hash of a profile is of what its own words read.
  for (const auto& [key, text] : options)
    if (!text.empty() && (key == "H" || r.hints.contains(key) || key == "particles") &&
        given.at(option_of(key).substr(2)))
      r.particles_hash.clear();
  if (given.contains("dim") && given.at("dim") && options.contains("dim")) r.hints["file_dim"] = options.at("dim");
  for (const char* const of_a_case : {"case", "dx"})
    if (given.contains(of_a_case) && given.at(of_a_case))
      throw error(fmt::format("--{} is about a case, and --particles names files", of_a_case));
  return r;
}

}  // namespace pairsum::harness

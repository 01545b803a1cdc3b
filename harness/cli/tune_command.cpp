#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/sum/grids.hpp>
#include "harness/cli/commands.hpp"
#include "harness/cli/profile_levels.hpp"
#include "harness/environment/machine.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/plan/levels.hpp"
#include "harness/plan/variants.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/rows/whole_file.hpp"
#include "harness/run/launch.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/program.hpp"
#include "harness/terminal/terminal.hpp"
#include "harness/tune/profile_json.hpp"
#include "harness/tune/tune_json.hpp"
#include "harness/tune/tune_text.hpp"

namespace pairsum::harness {
namespace {

constexpr level_option tune_options[] = {
    {"case", "dam_break", "initial condition (pairsum list)"},
    {"dx", "0.02", "particle spacing in m; 0.00594 is the talk's 2,014,966 particles"},
    {"state", "rest", "rest or perturbed"},
    {"dim", "3", "dimension"},
    {"H", "0", "support radius in m (0: 2 dx)"},
    {"interaction", "ferrari09", "pair interaction"},
    {"smoothing", "wendland_c2", "smoothing kernel"},
    {"order", "lattice", "order of memory at the start: lattice, shuffled, morton"},
    {"outside", "error", "particles outside Omega: error or drop"},
    {"seed", "1", "of the perturbation, of random places and of the order of measuring"},
    {"backend", "all", "backends to choose from, a list, or all"},
    {"grid", "all", "grids to choose from, a list, or all"},
    {"M", "6,7,8",
     "hash sizes to choose from, like 6,7 or 5..9; of the default a periodic box takes those that go round it"},
    {"isa", "default,best",
     "scalar, best, instruction sets to choose from; default: what each backend is made for; all"},
    {"block", "auto", "blocks to choose from, for backends that have some: auto, slab:4, ..."},
    {"precision", "double", "working precisions to choose from; what each costs in accuracy: docs/accuracy.md"},
    {"threads", "all", "numbers of threads to choose from; all: 1, 2, 4, ... and every core"},
    {"granularity", "default", "how loops are shared out; backends of one kind, if several"},
};

struct tune_settings {
  std::map<std::string, std::string> levels;
  tune_request request;
  std::string save = "tune.profile.json";
  bool json = false, oversubscribe = false;
};

template <class Names>
std::string list_of(const Names& names) {
  std::string text;
  for (const auto& n : names) text += (text.empty() ? "" : ",") + std::string(n);
  return text;
}

/// What "all" stands for.
std::string every_word(const std::string& key) {
  if (key == "grid") return list_of(grid_names());
  return list_of(available_backends());
}

/// Throws, before anything is measured, if a profile could not be written there, or would replace something else.
void check_writable(const std::string& path) {
  constexpr const char* instead = "; --save FILE names another file";
  std::error_code code;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (path.empty()) throw error("--save takes the name of a file, not \"\"");
  if (std::filesystem::is_directory(path, code)) throw error("cannot write " + path + ": it is a folder" + instead);
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
    throw error("cannot write " + path + ": it is no regular file" + instead);
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
    throw error("cannot write " + path + ": its folder is not there or not writable" + instead);
  if (std::filesystem::exists(path, code) && !is_profile(path))
    throw error("does not write over " + path + ", which is no profile of pairsum tune" + instead);
}

int start_tuning(const tune_settings& o, const given_options& given) {
  tune_request r = o.request;
  std::map<std::string, std::string> levels = o.levels;
  for (const char* const key : {"backend", "grid"})
    if (levels[key] == "all") levels[key] = every_word(key);
  r.levels = levels_of(levels, "", given);
  const std::string particles = take_particles(r.levels);
  check_cores(r.levels.threads, o.oversubscribe);
  r.rules.seed = r.levels.seed;
  check_writable(o.save);
  const registry& all = registry::instance();
  note_interrupts();
  const tune_result result = tune(r, all);
  std::FILE* const lines = o.json ? stderr : stdout;
  fmt::print(lines, "{}", particles);
  if (const std::string note = limits_note(); !note.empty()) fmt::print(lines, "note: {}\n", note);
  fmt::print(lines, "{}", tune_text(r, result, all, has_colours(lines)));
  const bool saved = result.winner && !result.interrupted;
  if (saved) {
    const bool replaces = is_profile(o.save);
    write_whole_file(profile_json(r, result, all).dump(2) + "\n", o.save);
    fmt::print(lines, "\nprofile: {}{}\nto measure it again:\n  {} run --profile {}{}\n", one_line(o.save),
               replaces ? " (in place of the one that was there)" : "", shell_word(called_as()), shell_word(o.save),
               o.oversubscribe ? " --oversubscribe" : "");
  }
  if (result.interrupted) fmt::print(lines, "interrupted; no profile was written\n");
  if (o.json) fmt::print("{}\n", tune_json(r, result, all, saved ? one_line(o.save) : "").dump(2));
  if (result.interrupted) return 130;
  return std::ranges::count(result.candidates, fate::wrong, &contestant::what) == 0 ? 0 : 1;
}

}  // namespace

void add_tune_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand(
      "tune",
      "Finds what is fastest for one case on this machine, within a time: backend, grid, M, block, precision and "
      "number\nof threads. Every candidate gets a look; those that are clearly slower are dropped; the others are "
      "measured in\ninterleaved rounds. No time counts before its rates were verified.");
  const auto o = std::make_shared<tune_settings>();
  for (const level_option& option : tune_options)
    command->add_option(std::string("--") + option.key, o->levels[option.key] = option.standard, option.what)
        ->capture_default_str();
  const CLI::Option* const M = command->get_option("--M");
  add_particle_options(*command, o->levels);
  command->add_option("--budget", o->request.budget_s, "seconds for everything, particles and reference included")
      ->capture_default_str();
  command->add_option("--phase", o->request.phase, "what is to be fast: total (a whole step) or sum (alone)")
      ->capture_default_str();
  command->add_option("--binding", o->request.binding, "cores_first: pins threads, one on every core first; none")
      ->capture_default_str();
  command->add_flag("--oversubscribe", o->oversubscribe, "allow more threads than the machine has for this job");
  command->add_option("--save", o->save, "the file of the profile, which pairsum run --profile takes")
      ->capture_default_str();
  command->add_flag("--json", o->json, "what was found as one JSON document on stdout, the text on stderr");
  add_plugin_option(*command);
  command->footer(
      "Examples:\n"
      "  pairsum tune --dx 0.012                           a minute\n"
      "  pairsum run --profile tune.profile.json           measures what it found as a study\n"
      "  pairsum tune --dx 0.00594 --budget 180 --save talk.profile.json");
  command->callback([&chosen, o, M, command] {
    o->request.all_M = M->count() > 0;
    const given_options given = given_of(*command);
    chosen = [o, given] { return start_tuning(*o, given); };
  });
}

}  // namespace pairsum::harness

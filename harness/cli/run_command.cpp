#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include "harness/cli/commands.hpp"
#include "harness/environment/machine.hpp"
#include "harness/plan/levels.hpp"
#include "harness/plan/study.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/run/dry_run.hpp"
#include "harness/run/study.hpp"
#include "harness/run/worker.hpp"
#include "harness/tune/profile_json.hpp"

namespace pairsum::harness {
namespace {

struct level_option {
  const char *key, *standard, *what;
};

/// The factors and numbers of a run without a plan, with their defaults.
constexpr level_option level_options[] = {
    {"case", "dam_break", "initial condition (pairsum list)"},
    {"dx", "0.02", "particle spacing in m, a list; 0.00594 is the talk's 2,014,966 particles"},
    {"state", "rest", "rest, perturbed, or both"},
    {"backend", "naive_omp,symmetric_omp", "backends, a list, or all (pairsum list)"},
    {"M", "6,7", "hash sizes, like 6,7 or 5..9: the grid is folded to 2^M cells an axis"},
    {"threads", "all", "numbers of threads; all: 1, 2, 4, ... and every core; cores: every core alone"},
    {"granularity", "default",
     "how loops are shared out: dynamic:32, static:0, guided:8 (OpenMP), auto:32, simple:8 (oneTBB)"},
    {"dim", "3", "dimension"},
    {"H", "0", "support radius in m (0: 2 dx)"},
    {"precision", "double", "working precisions, a list"},
    {"interaction", "ferrari09", "pair interactions, a list"},
    {"smoothing", "wendland_c2", "smoothing kernels, a list"},
    {"integrator", "euler", "time stepping, a list"},
    {"dt", "1e-5", "time step in s"},
    {"grid", "hashed_grid", "grids, a list; those that take no M are measured once"},
    {"isa", "default", "scalar, best, instruction sets, a list; default: best for tiles, scalar for others; all"},
    {"block", "auto", "blocks of backends that have some, a list: auto, slab:4, pencil:4, brick:4 (4 cells wide)"},
    {"order", "lattice", "orders of memory at the start, a list: lattice, shuffled, morton"},
    {"outside", "error", "particles outside Omega: error or drop"},
    {"steps", "5", "time steps per repetition"},
    {"repetitions", "1", "how often a round measures each point"},
    {"seed", "1", "of the perturbation, of random places and of the order of measuring"},
};

constexpr int rounds_of_interval = 6;  ///< fewer give no interval of 95 % for a median

struct run_options {
  std::string plan, profile, study = "run", out, results = "results", binding = "cores_first";
  std::map<std::string, std::string> levels;
  std::vector<std::string> programs;
  int rounds = 6;
  double budget_s = 0, half_width = 0;
  bool fresh = false, dry_run = false, show_plan = false, peaks = false;
};

/// What was given beside the defaults, by option name without dashes.
using given_options = std::map<std::string, bool>;

/// The levels of a profile, where no option says otherwise.
run_request profile_levels(const run_options& o, const given_options& given) {
  const saved_profile p = read_profile(o.profile);
  if (const std::string text = differences(p); !text.empty()) fmt::print("note: {}\n", text);
  run_request r = p.levels;
  for (const auto& [key, text] : o.levels)
    if (given.at(key) || !profile_says(key)) read_level(r, key, text, usable_cores(), "--" + key);
  return r;
}

study_plan plan_from_options(const run_options& o, const given_options& given) {
  study_plan plan;
  plan.study = o.study;
  plan.title = "run";
  plan.peaks = o.peaks;
  part_plan part;
  if (!o.profile.empty()) part.request = profile_levels(o, given);
  part.request.study = o.study;
  if (o.profile.empty())
    for (const auto& [key, text] : o.levels) read_level(part.request, key, text, usable_cores(), "--" + key);
  plan.parts.push_back(part);
  return plan;
}

study_plan plan_of(const run_options& o, const given_options& given) {
  if (o.plan.empty()) return plan_from_options(o, given);
  if (given.at("profile")) throw error("--profile names points, and so does the plan " + o.plan);
  for (const level_option& level : level_options)
    if (given.at(level.key) && std::string(level.key) != "seed")
      throw error(fmt::format("--{} is said by the plan {}; --show-plan prints it, for a plan file of your own",
                              level.key, o.plan));
  if (given.at("study")) throw error("--study is said by the plan " + o.plan);
  study_plan plan = parse_plan(load_plan(o.plan), usable_cores());
  if (given.at("seed"))
    for (part_plan& p : plan.parts) read_level(p.request, "seed", o.levels.at("seed"), 0, "--seed");
  return plan;
}

int start(const run_options& o, const given_options& given) {
  study_plan plan = plan_of(o, given);
  if (given.at("budget") && !(o.budget_s >= 0))
    throw error(fmt::format("budget must be at least 0, is {}", o.budget_s));
  if (given.at("budget")) plan.budget_s = o.budget_s;
  for (part_plan& p : plan.parts) {
    if (given.at("half-width")) p.half_width = o.half_width;
    if (o.plan.empty() || given.at("rounds")) {
      p.most_rounds = o.rounds;
      p.least_rounds = p.half_width > 0 ? std::min(o.rounds, rounds_of_interval) : o.rounds;
    }
    if (p.least_rounds < 1) throw error(fmt::format("rounds must be at least 1, is {}", p.least_rounds));
    if (!(p.half_width >= 0)) throw error(fmt::format("half-width must be at least 0, is {}", p.half_width));
  }
  if (o.show_plan) {
    fmt::print("{}\n", plan_json(plan).dump(2));
    return 0;
  }
  const registry& all = registry_of(plan);
  check_plan(plan, all);
  if (o.dry_run) {
    fmt::print("{}", dry_run(plan, all));
    return 0;
  }
  if (plan.builds != static_cast<int>(o.programs.size()) + 1)
    throw error(plan.builds == 1
                    ? std::string("--program names another build, which only a plan that compares builds takes")
                    : fmt::format("the plan compares {} builds: name the {} with --program; {} {} named", plan.builds,
                                  plan.builds == 2 ? "other one" : "others", o.programs.size(),
                                  o.programs.size() == 1 ? "is" : "are"));
  if (!o.programs.empty() && !loaded_plugins().empty())
    throw error("a study that compares builds takes no --plugin, which is of one build");
  if (given.at("profile") && o.profile.empty()) throw error("--profile takes the name of a file, not \"\"");
  if (given.at("out") && o.out.empty()) throw error("--out takes the name of a file, not \"\"");
  study_options options;
  options.binding = o.binding;
  options.out =
      o.out.empty() ? rows_path(o.results, plan, o.fresh || o.plan.empty(), o.binding) : std::filesystem::path(o.out);
  if (o.fresh && std::filesystem::exists(options.out))
    throw error(fmt::format("--fresh makes a new file, but {} is there", options.out.string()));
  options.builds.push_back(in_a_process(this_program()));
  for (const std::string& program : o.programs) options.builds.push_back(in_a_process(program));
  const int code = conduct(plan, options, all);
  std::error_code none;
  if (std::filesystem::exists(options.out, none)) fmt::print("rows: {}\n", options.out.string());
  return code;
}

}  // namespace

void add_run_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand(
      "run",
      "Carries out a study: a plan that comes with the program (pairsum list), a plan file, or the points that "
      "options\n"
      "name. Every round is a fresh process with pinned threads, its points interleaved in a seeded order; every step "
      "is\n"
      "verified before its time is written. A study that was cut goes on where it was when it is started again.");
  const auto o = std::make_shared<run_options>();
  command->add_option("plan", o->plan, "name of a plan, or a .json file; without: the options below");
  for (const level_option& level : level_options)
    command->add_option(std::string("--") + level.key, o->levels[level.key] = level.standard, level.what)
        ->capture_default_str();
  command->add_option("--profile", o->profile,
                      "file of pairsum tune --save: its case and its winner's words where no option says otherwise");
  command->add_option("--study", o->study, "name of the study, a folder under --results")->capture_default_str();
  command
      ->add_option(
          "--rounds", o->rounds,
          "fresh processes that measure all points; intervals need at least 6, and --half-width may end before")
      ->capture_default_str();
  command->add_option("--half-width", o->half_width,
                      "stop a part when every interval's half-width is below this share of its median (0: never)");
  command->add_option("--budget", o->budget_s, "seconds for everything (0: no limit)");
  command->add_option("--binding", o->binding, "cores_first: pins threads, one on every core first; none")
      ->capture_default_str();
  command->add_option("--program", o->programs, "another build of this program, for plans that compare builds");
  command->add_flag("--peaks", o->peaks, "measure the machine's bandwidth and peak first (plans say so themselves)");
  command->add_flag("--dry-run", o->dry_run, "print the design and about how long it takes; measure nothing");
  command->add_flag("--show-plan", o->show_plan, "print the plan as JSON; measure nothing");
  command->add_flag("--fresh", o->fresh, "start over into a new file instead of resuming");
  command->add_option("--out", o->out,
                      "rows file; appended to or resumed if it exists (default: RESULTS/STUDY/HOST-UTC-GIT.jsonl)");
  command->add_option("--results", o->results, "folder of the default rows file")->capture_default_str();
  add_plugin_option(*command);
  command->footer(
      "Examples:\n"
      "  pairsum run quick                 a small version of everything, about a minute\n"
      "  pairsum run talk --dry-run        what the talk's study measures, and how long it takes\n"
      "  pairsum run --dx 0.012 --backend naive_omp,symmetric_omp --M 6,7 --threads all");
  command->callback([&chosen, o, command] {
    given_options given;
    for (const CLI::Option* option : command->get_options()) given[option->get_single_name()] = option->count() > 0;
    chosen = [o, given] { return start(*o, given); };
  });
}

}  // namespace pairsum::harness

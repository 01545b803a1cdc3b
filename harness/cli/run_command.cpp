#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include <pairsum/core/error.hpp>
#include "harness/cli/commands.hpp"
#include "harness/cli/profile_levels.hpp"
#include "harness/cli/sbatch.hpp"
#include "harness/environment/machine.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/plan/levels.hpp"
#include "harness/plan/narrow.hpp"
#include "harness/plan/study.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/run/by_ranks.hpp"
#include "harness/run/dry_run.hpp"
#include "harness/run/point_setup.hpp"
#include "harness/run/study.hpp"
#include "harness/run/worker.hpp"
#include "harness/run/writable_file.hpp"

namespace pairsum::harness {
namespace {

constexpr level_option comparison_options[] = {
    {"backend", "naive_omp,symmetric_omp", "backends, or all (pairsum list)"},
    {"M", "6,7", "hash sizes, like 6,7 or 5..9: the grid folds to 2^M cells an axis"},
    {"threads", "all", "numbers of threads; all: 1, 2, 4, ... all cores; cores: all; cores/ranks"},
    {"ranks", "1", "numbers of ranks of an MPI job, which share the particles"},
    {"cut", "twice", "pairs across ranks: twice: both sum them; once: one does, and sends back"},
    {"grid", "hashed_grid", "grids; those that take no M are measured once"},
    {"precision", "double", "working precisions"},
    {"isa", "default", "scalar, best, avx2, all; default: best for tiles, scalar for others"},
    {"block", "auto", "of backends with blocks of cells: auto, slab:4, pencil:4, brick:4"},
    {"granularity", "default", "of loops: dynamic:32, static:0, guided:8 (OpenMP); auto:32 (oneTBB)"},
};
constexpr level_option case_options[] = {
    {"case", "dam_break", "initial condition (pairsum list)"},
    {"dx", "0.02", "particle spacings in m; 0.00594: the talk's 2,014,966 particles"},
    {"state", "rest", "rest, perturbed"},
    {"dim", "3", "dimension"},
    {"H", "0", "support radius in m; 0: 2 dx"},
    {"interaction", "ferrari09", "pair interactions"},
    {"smoothing", "wendland_c2", "smoothing kernels"},
    {"integrator", "euler", "time stepping"},
    {"dt", "1e-5", "time step in s"},
    {"order", "lattice", "order of particles in memory: lattice, shuffled, morton"},
    {"outside", "error", "particles outside Omega: error, drop"},
    {"seed", "1", "of perturbation, random places and order of measuring"},
};
constexpr level_option round_options[] = {
    {"steps", "5", "time steps per repetition"},
    {"repetitions", "1", "how often a round measures each point"},
};

struct option_group {
  const char* name;
  std::span<const level_option> options;
};
constexpr const char* round_group = "How often";
constexpr option_group level_groups[] = {
    {"What is compared, without a plan (lists)", comparison_options},
    {"The case, without a plan", case_options},
    {round_group, round_options},
};

constexpr int rounds_of_interval = 6;  ///< fewer give no interval of 95 % for a median

struct run_options {
  std::string plan, profile, study = "run", out, results = "results", binding = "cores_first",
                             launcher = default_launcher;
  std::string again;    ///< the words that were given
  std::string in_jobs;  ///< those that a job script gives
  std::map<std::string, std::string> levels;
  std::vector<std::string> programs, only;
  std::int64_t rounds = 6;
  double budget_s = 0, half_width = 0;
  bool fresh = false, dry_run = false, show_plan = false, sbatch = false, peaks = false, oversubscribe = false;
};

study_plan plan_from_options(const run_options& o, const given_options& given) {
  study_plan plan;
  plan.study = o.study;
  plan.title = "run";
  plan.peaks = o.peaks;
  part_plan part;
  std::map<std::string, std::string> levels = o.levels;
  if (!given.at("ranks")) levels["ranks"] = std::to_string(default_ranks());
  if (!given.at("threads") && levels["ranks"] != "1") levels["threads"] = "cores/ranks";
  part.request = levels_of(levels, o.profile, given);
  part.request.study = o.study;
  plan.parts.push_back(part);
  return plan;
}

/// Does something that may find the plan wrong; what it throws names the plan, too.
template <class Work>
auto in_plan(const run_options& o, Work&& work) {
  try {
    return work();
  } catch (const error& e) {
    throw o.plan.empty() ? e : error(fmt::format("{}: {}", o.plan, e.what()));
  }
}

study_plan plan_of(const run_options& o, const given_options& given) {
  if (o.plan.empty()) return plan_from_options(o, given);
  if (given.at("profile")) throw error("--profile names points, and so does the plan " + o.plan);
  for (const auto& [key, text] : o.levels)
    if (given.at(option_of(key).substr(2)) && key != "seed")
      throw error(
          fmt::format("{0} is said by the plan {1}; --only {2}=... narrows it, --show-plan prints it, for a plan "
                      "file of your own",
                      option_of(key), o.plan, key));
  if (given.at("study")) throw error("--study is said by the plan " + o.plan);
  nlohmann::json text = load_plan(o.plan);
  if (text.is_object() && default_ranks() > 1) {
    nlohmann::json& defaults = text["defaults"];
    if (defaults.is_null() || (defaults.is_object() && !defaults.contains("ranks")))
      defaults["ranks"] = default_ranks();
  }
  study_plan plan = in_plan(o, [&] { return parse_plan(text, usable_cores()); });
  if (given.at("seed"))
    for (part_plan& p : plan.parts) read_level(p.request, "seed", o.levels.at("seed"), 0, "--seed");
  return plan;
}

/// The words that were given, but for where rows go and these.
std::string words_of(const CLI::App& command, const std::set<std::string>& left_out = {}) {
  std::string words = "run";
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_single_name();
    if (option->count() == 0 || name == "out" || name == "results" || name == "fresh" || left_out.contains(name))
      continue;
    for (const std::string& value : option->results()) {
      if (!option->get_positional()) words += " --" + name;
      if (option->get_items_expected_max() > 0) words += " " + shell_word(value);
    }
  }
  return words;
}

/// The numbers of threads of the plan's points, of all their ranks together; serial backends have 1, whatever their
/// part says.
std::vector<int> threads_of(const study_plan& plan, const registry& all) {
  std::vector<int> threads;
  for (const part_plan& part : plan.parts)
    for (const world_plan& points : expand(part.request, all))
      for (const point& p : points) threads.push_back(p.threads * p.ranks);
  return threads;
}

/// The processes of a study are told the name of their file as JSON.
void check_name(const std::string& file) {
  try {
    static_cast<void>(nlohmann::json(file).dump());
  } catch (const nlohmann::json::exception&) {
    throw error(fmt::format("cannot write rows to {}: its name should be UTF-8", file));
  }
}

/// Prints the job script that carries out the plan.
int print_sbatch(const run_options& o, const study_plan& plan, const registry& all, bool launcher_given) {
  if (launcher_given) static_cast<void>(launcher_words(o.launcher, 1));
  const std::string out =
      o.out.empty() ? (std::filesystem::path(o.results) / plan.study / "sbatch.jsonl").string() : o.out;
  check_name(out);
  fmt::print("{}", sbatch_script(plan, all,
                                 {std::filesystem::canonical(this_program()), std::filesystem::current_path(),
                                  o.in_jobs, launcher_given ? o.launcher : "", out}));
  return 0;
}

int start(const run_options& o, const given_options& given) {
  if (o.sbatch) check_sbatch(given);
  study_plan plan = plan_of(o, given);
  narrow(plan, o.only, usable_cores());
  if (given.at("budget") && !(o.budget_s >= 0 && std::isfinite(o.budget_s)))
    throw error(fmt::format("budget must be at least 0 and finite, is {}", o.budget_s));
  if (given.at("budget")) plan.budget_s = o.budget_s;
  for (part_plan& p : plan.parts) {
    if (given.at("half-width")) p.half_width = o.half_width;
    if (o.plan.empty() || given.at("rounds")) {
      if (o.rounds < 1 || o.rounds > rounds_limit)
        throw error(fmt::format("rounds must be at least 1 and at most {}, is {}", rounds_limit, o.rounds));
      p.most_rounds = static_cast<int>(o.rounds);
      p.least_rounds = p.half_width > 0 ? std::min(p.most_rounds, rounds_of_interval) : p.most_rounds;
    }
    if (!(p.half_width >= 0 && std::isfinite(p.half_width)))
      throw error(fmt::format("half-width must be at least 0 and finite, is {}", p.half_width));
  }
  std::set<std::string> told;
  for (part_plan& p : plan.parts)
    if (const std::string table = take_particles(p.request); told.insert(table).second && !o.show_plan && !o.sbatch)
      fmt::print("{}", table);
  if (o.show_plan) {
    fmt::print("{}\n", plan_json(plan).dump(2));
    return 0;
  }
  const registry& all = registry_of(plan);
  told.clear();
  for (part_plan& p : plan.parts)
    if (const std::string left_out = leave_out_wide_skins(p.request, all); told.insert(left_out).second && !o.sbatch)
      fmt::print("{}", left_out);
  if (o.dry_run) {
    fmt::print("{}", in_plan(o, [&] { return dry_run(plan, all); }));
    if (const std::string why = too_many(threads_of(measurable(plan, all).plan, all)); !why.empty() && !o.oversubscribe)
      fmt::print("it would be refused: {}\n", why);
    return 0;
  }
  in_plan(o, [&] { check_plan(plan, all); });
  if (!o.sbatch) check_cores(threads_of(plan, all), o.oversubscribe);
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
  if (o.sbatch) return print_sbatch(o, plan, all, given.at("launcher"));
  study_options options;
  options.binding = o.binding;
  if (o.fresh && !o.out.empty() && std::filesystem::exists(o.out))
    throw error(fmt::format("--fresh makes a new file, but {} is there", o.out));
  options.builds.push_back(in_a_process(this_program(), o.launcher));
  for (const std::string& program : o.programs) options.builds.push_back(in_a_process(program, o.launcher));
  check_name(o.out.empty() ? o.results : o.out);
  const new_folders made(o.out.empty() ? std::filesystem::path(o.results) / plan.study : std::filesystem::path());
  options.out = o.out.empty() ? rows_path(o.results, plan, o.fresh, o.binding) : std::filesystem::path(o.out);
  options.program = called_as();
  options.again = o.again;
  if (const int ranks = default_ranks(); ranks > 1) options.before = fmt::format("{} -n {} ", o.launcher, ranks);
  return conduct(plan, options, all);
}

/// The help's groups with one blank line between them, so that they fit on a screen.
struct close_groups : CLI::Formatter {
  std::string make_group(std::string group, bool positional, std::vector<const CLI::Option*> options) const override {
    const std::string text = CLI::Formatter::make_group(std::move(group), positional, std::move(options));
    return positional ? text + "\n" : text.substr(1);
  }
};

/// In the help, defaults stand in the text.
void described(CLI::Option* option, const char* group) { option->option_text(" ")->group(group); }

void add_levels(CLI::App& command, run_options& o) {
  for (const option_group& group : level_groups)
    for (const level_option& level : group.options)
      described(command.add_option(std::string("--") + level.key, o.levels[level.key] = level.standard,
                                   fmt::format("{} [{}]", level.what, level.standard)),
                group.name);
}

}  // namespace

void add_run_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand(
      "run",
      "Carries out a study: a plan (pairsum list), a plan file, or the points that options name. Every\n"
      "round is a fresh process with pinned threads; every step is verified before its time counts.\n"
      "A study that was cut goes on where it was when the same command is given again.");
  const auto o = std::make_shared<run_options>();
  const auto layout = std::make_shared<close_groups>();
  layout->column_width(20);
  command->formatter(layout);
  const auto text = [&](const char* name, std::string& value, const char* what, const char* group) {
    described(command->add_option(name, value, what), group);
  };
  const auto flag = [&](const char* name, bool& value, const char* what, const char* group) {
    command->add_flag(name, value, what)->group(group);
  };
  const char *const design = "The plan", *const files = "Files", *const machine = "Machine and build";
  described(command->add_option("plan", o->plan, "name of a plan, or a .json file; without: the options below"),
            design);
  described(command->add_option("--only", o->only, "LEVEL=A,B: only these of the plan's; repeatable")
                ->allow_extra_args(false),
            design);
  text("--profile", o->profile, "file of pairsum tune: its case and winner where no option says otherwise", design);
  flag("--dry-run", o->dry_run, "print the design and about how long it takes; measure nothing", design);
  flag("--show-plan", o->show_plan, "print the plan as JSON; measure nothing", design);
  flag("--sbatch", o->sbatch, "print a job script for Slurm that does all this; measure nothing", design);
  add_levels(*command, *o);
  described(add_particle_options(*command, o->levels), "The case, without a plan");
  described(command->add_option("--rounds", o->rounds, "fresh processes that measure all points; intervals need 6 [6]"),
            round_group);
  described(command->add_option("--half-width", o->half_width,
                                "end a part when all intervals are within this share; 0: never"),
            round_group);
  described(command->add_option("--budget", o->budget_s, "seconds for everything; 0: no limit"), round_group);
  text("--out", o->out, "rows file; resumed or appended to [RESULTS/STUDY/HOST-UTC-GIT.jsonl]", files);
  flag("--fresh", o->fresh, "start over in a new file instead of resuming", files);
  text("--results", o->results, "folder of studies [results]", files);
  text("--study", o->study, "name of a study without a plan, its folder there [run]", files);
  text("--binding", o->binding, "cores_first: pins threads, one on every core first; none [cores_first]", machine);
  text("--launcher", o->launcher, "what starts ranks: mpirun, srun, \"mpirun --hostfile FILE\" [mpirun]", machine);
  flag("--oversubscribe", o->oversubscribe, "allow more threads than the machine has for this job", machine);
  flag("--peaks", o->peaks, "measure the machine's bandwidth and peak first, as plans may", machine);
  described(command->add_option("--program", o->programs, "another build, for plans that compare builds"), machine);
  add_plugin_option(*command);
  command->get_option("--plugin")->description("shared object with backends or interactions; repeatable");
  described(command->get_option("--plugin"), machine);
  command->get_help_ptr()->group(design);
  command->footer(
      "Examples:\n"
      "  pairsum run quick                 a small version of everything, about a minute\n"
      "  pairsum run talk --dry-run        what the talk's study measures, and how long it takes\n"
      "  pairsum run talk --only backend=naive_omp,symmetric_omp --only threads=cores\n"
      "  pairsum run --dx 0.012 --backend naive_omp,symmetric_omp --M 6,7 --threads all");
  command->callback([&chosen, o, command] {
    const given_options given = given_of(*command);
    o->again = words_of(*command);
    o->in_jobs = words_of(*command, {"sbatch", "launcher"});
    chosen = [o, given] { return start(*o, given); };
  });
}

}  // namespace pairsum::harness

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include "harness/cli/commands.hpp"
#include "harness/environment/environment.hpp"
#include "harness/plan/levels.hpp"
#include "harness/plan/refusal.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/run/by_ranks.hpp"
#include "harness/terminal/program.hpp"

namespace {

constexpr const char* about =
    "pairsum sums short-range pair interactions of particles with many algorithms, verifies each,\n"
    "measures them against each other, and says which to take.\n";
constexpr const char* examples =
    "Examples:\n"
    "  pairsum list                                          what there is\n"
    "  pairsum verify                                        every backend against the O(N^2) reference\n"
    "  pairsum run quick                                     a small study of everything, about a minute\n"
    "  pairsum run --dx 0.02 --backend naive_omp,symmetric_omp --M 6,7 --threads 1,2\n"
    "  pairsum tune --dx 0.02                                what is fastest for a case, in a minute\n"
    "  pairsum info particles.hdf5                           what is in a file of particles, and how many pairs\n"
    "  pairsum report results/run                            tables, figures and a page of what was measured\n"
    "  pairsum compare naive_omp symmetric_omp --in results  which is faster, and how sure is that\n"
    "  pairsum history results                               did anything get slower from revision to revision\n"
    "  pairsum convert particles.vtu out.hdf                 particles of other programs, to read here or in ParaView\n"
    "Exit codes: 0 fine, 1 a verification failed or something got slower, 2 bad input, 130 interrupted.";

/// The error for a word that no option and no argument takes: names the option that was meant.
pairsum::error unexpected(const CLI::App& app, const std::string& word) {
  const auto commands = app.get_subcommands();
  std::vector<std::string> valid;
  for (const CLI::Option* o : (commands.empty() ? &app : commands.front())->get_options())
    for (const std::string& name : o->get_lnames()) valid.push_back("--" + name);
  const std::string name = word.substr(0, word.find('='));
  const std::string bare = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  const std::string command = pairsum::harness::called(app);
  const std::string what =
      word.starts_with('-') ? "unknown option " + name + " of " + command : command + " does not take \"" + word + "\"";
  return pairsum::error(
      fmt::format("{};{} {} --help lists its options", what, pairsum::hint_for("--" + bare, valid), command));
}

/// The levels that take a list.
std::vector<std::string> list_levels() {
  const nlohmann::json levels = pairsum::harness::levels_json({});
  std::vector<std::string> lists;
  for (const auto& level : levels.items())
    if (level.value().is_array()) lists.push_back(level.key());
  return lists;
}

int run_program(int argc, char** argv) {
  CLI::App app(about, "pairsum");
  app.footer(examples);
  app.require_subcommand(1);
  app.set_version_flag("--version", pairsum::harness::describe_build(), "print version, revision, compiler and flags");
  pairsum::harness::action chosen;
  pairsum::harness::add_list_command(app, chosen);
  pairsum::harness::add_verify_command(app, chosen);
  pairsum::harness::add_run_command(app, chosen);
  pairsum::harness::add_worker_command(app, chosen);
  pairsum::harness::add_tune_command(app, chosen);
  pairsum::harness::add_simulate_command(app, chosen);
  pairsum::harness::add_info_command(app, chosen);
  pairsum::harness::add_results_commands(app, chosen);
  if (argc > 1 && argv[1][0] != '-') {
    std::vector<std::string> commands;
    for (const CLI::App* c : app.get_subcommands({}))
      if (!c->get_group().empty() || c->get_name() == argv[1]) commands.push_back(c->get_name());
    if (std::find(commands.begin(), commands.end(), argv[1]) == commands.end())
      throw pairsum::unknown_name("command", argv[1], commands);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    if (const auto words = app.remaining(true); !words.empty()) throw unexpected(app, words.front());
    throw pairsum::harness::refusal(app, e, list_levels());
  }
  pairsum::harness::load_named_plugins();
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  return pairsum::harness::as_program("pairsum", [&] {
    const std::string_view command = argc < 2 ? "" : argv[1];
    if (command != "job") {
      const bool takes_ranks = command == "run" || command == "verify" || command == "simulate";
      return takes_ranks && pairsum::harness::left_to_the_first() ? 0 : run_program(argc, argv);
    }
    argv[1] = argv[0];  // what run_job() starts
    return pairsum::harness::as_rank([&] { return run_program(argc - 1, argv + 1); });
  });
}

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include "harness/cli/commands.hpp"
#include "harness/environment/environment.hpp"
#include "harness/plan/levels.hpp"
#include "harness/plugin/plugins.hpp"
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

/// The command that was called, "pairsum run".
std::string called(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app.get_name() : app.get_name() + " " + commands.front()->get_name();
}

/// The error for a word that no option and no argument takes: names the option that was meant.
pairsum::error unexpected(const CLI::App& app, const std::string& word) {
  const auto commands = app.get_subcommands();
  std::vector<std::string> valid;
  for (const CLI::Option* o : (commands.empty() ? &app : commands.front())->get_options())
    for (const std::string& name : o->get_lnames()) valid.push_back("--" + name);
  const std::string name = word.substr(0, word.find('='));
  const std::string bare = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  const std::string what = word.starts_with('-') ? "unknown option " + name + " of " + called(app)
                                                 : called(app) + " does not take \"" + word + "\"";
  return pairsum::error(
      fmt::format("{};{} {} --help lists its options", what, pairsum::hint_for("--" + bare, valid), called(app)));
}

/// Is an option a level that takes a list?
bool is_list(const std::string& option) {
  const nlohmann::json levels = pairsum::harness::levels_json({});
  const auto level = levels.find(option.substr(2));
  return level != levels.end() && level->is_array();
}

/// What is wrong with words that CLI11 refuses.
std::string refusal(const CLI::App& app, const CLI::ParseError& e) {
  const auto commands = app.get_subcommands();
  for (const CLI::Option* o : (commands.empty() ? &app : commands.front())->get_options())
    if (o->get_items_expected_max() == 1 && o->results().size() > 1 && !o->get_positional())
      return fmt::format("{} is given {} times, should be once", o->get_name(), o->results().size()) +
             (is_list(o->get_name())
                  ? fmt::format("; a list has commas: {} {}", o->get_name(), fmt::join(o->results(), ","))
                  : "");
  return e.what();
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
    throw pairsum::error(fmt::format("{} (see {} --help)", refusal(app, e), called(app)));
  }
  pairsum::harness::load_named_plugins();
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  return pairsum::harness::as_program("pairsum", [&] { return run_program(argc, argv); });
}

#pragma once
#include <functional>

namespace CLI {
class App;
}

namespace pairsum::harness {

/// A factor or number of a study as an option, with its default.
struct level_option {
  const char *key, *standard, *what;
};

/// Each adds its subcommand to the program; `chosen` receives what to do if that subcommand was called, and returns the
/// exit code.
using action = std::function<int()>;
void add_list_command(CLI::App& app, action& chosen);
void add_verify_command(CLI::App& app, action& chosen);
void add_run_command(CLI::App& app, action& chosen);
void add_worker_command(CLI::App& app, action& chosen);
void add_tune_command(CLI::App& app, action& chosen);
void add_simulate_command(CLI::App& app, action& chosen);
void add_info_command(CLI::App& app, action& chosen);
/// report, compare, history and convert.
void add_results_commands(CLI::App& app, action& chosen);

}  // namespace pairsum::harness

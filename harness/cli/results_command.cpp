// report, compare and history: what is done with rows after they were measured is Python's (plots/pairsum_results), and
// so is convert: other programs' particle files are read by Python's libraries.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <pairsum/core/error.hpp>
#include "harness/cli/commands.hpp"

namespace pairsum::harness {
namespace {

/// The folder that holds the package: known from where this program lies.
std::string python_folder() {
  std::error_code code;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", code);
  return (program.parent_path() / PAIRSUM_PYTHON_FOLDER).lexically_normal();
}

/// PYTHON, or the system's, which sees the system's packages.
std::string interpreter() {
  if (const char* const named = std::getenv("PYTHON"); named != nullptr && *named != '\0') return named;
  return ::access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
}

/// Runs a program of the package in place of this one.
[[noreturn]] void run_python(const std::string& program, const std::vector<std::string>& words) {
  std::string path = python_folder();
  if (!std::filesystem::is_directory(path + "/pairsum_results"))
    throw error(program + " is Python, and " + path + " has no package pairsum_results; install pairsum again");
  if (const char* const more = std::getenv("PYTHONPATH"); more != nullptr && *more != '\0')
    path += ':' + std::string(more);
  ::setenv("PYTHONPATH", path.c_str(), 1);
  ::setenv("PYTHONDONTWRITEBYTECODE", "1", 0);
  std::vector<std::string> all{interpreter(), "-m", "pairsum_results", program};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : all) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  throw error(program + " is Python, and \"" + all[0] + "\" cannot be run (" + std::strerror(errno) +
              "); install python3, or name another with PYTHON");
}

}  // namespace

void add_results_commands(CLI::App& app, action& chosen) {
  for (const auto& [name, about] :
       {std::pair{"report", "Tables, CSV, summary.json, figures and report.html from rows files"},
        {"compare", "Is B faster than A, by how much, and how sure is that?"},
        {"history", "From revision to revision: what got slower or faster?"},
        {"convert", "Particle files of other programs (VTK, LAMMPS, GROMACS, GSD, ...) to one .hdf"}}) {
    CLI::App* const command = app.add_subcommand(name, about);
    command->set_help_flag();  // Python's own
    command->prefix_command();
    command->callback(
        [&chosen, command] { chosen = [command]() -> int { run_python(command->get_name(), command->remaining()); }; });
  }
}

}  // namespace pairsum::harness

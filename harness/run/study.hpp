#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/plan/study.hpp"
#include "harness/run/launch.hpp"

namespace pairsum::harness {

/// How a plan is carried out.
struct study_options {
  std::filesystem::path out;            ///< rows file; made, appended to or resumed
  std::string binding = "cores_first";  ///< how threads are pinned (thread_binding)
  std::vector<launcher> builds;         ///< one per program that is compared; this one's first
  std::string program = "pairsum";      ///< this program, as a user calls it
  std::string before{};                 ///< what started the job that it runs in
  std::string again{};                  ///< its words that start the study again, but for --out
};

/// Where rows go if the user does not say: an unfinished file of the same plan, machine and build under
/// <results>/<study>, else a new <results>/<study>/<host>-<utc>-<git>.jsonl.
/// @param fresh never an unfinished one, as with a build of uncommitted changes
/// @param binding as in study_options
std::filesystem::path rows_path(const std::filesystem::path& results, const study_plan& plan, bool fresh,
                                const std::string& binding = "cores_first");

/// Carries a plan out and appends its rows: per part first every point is verified, then rounds are measured, each in a
/// fresh process per build, until the part has its rounds, its intervals are narrow enough or its share of the budget
/// is used (one round is always made). A finished round is closed by a round row and never repeated; one that was cut
/// is voided and measured again, also when the study was killed and is started anew. Prints a table, and the command
/// that comes next, to stdout. Returns the exit code: 0, 1 if a point failed its verification, 2 after an error that
/// was said, 130 after SIGINT. Throws pairsum::error for a wrong plan, or a file that another study is writing or that
/// another build or machine wrote.
int conduct(const study_plan& plan, const study_options& options, const registry& all);

}  // namespace pairsum::harness

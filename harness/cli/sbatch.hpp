#pragma once
#include <filesystem>
#include <string>

#include "harness/cli/profile_levels.hpp"
#include "harness/plan/study.hpp"

namespace pairsum::harness {

/// What a job script calls, beside the plan.
struct sbatch_call {
  std::filesystem::path program, folder;  ///< the program, and where the script calls it
  std::string words;                      ///< of the command, as a shell reads them, without --launcher and --out
  std::string launcher;                   ///< empty: the script finds one
  std::string out;                        ///< the rows file
};

/// Throws pairsum::error for what makes no sense beside --sbatch.
void check_sbatch(const given_options& given);

/// A commented script for Slurm's sbatch that carries the plan out, and goes on with it each time it is submitted.
/// Nodes, tasks and time are guesses from this machine.
std::string sbatch_script(const study_plan& plan, const registry& all, const sbatch_call& call);

}  // namespace pairsum::harness

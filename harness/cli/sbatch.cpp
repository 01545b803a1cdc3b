#include "harness/cli/sbatch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include <pairsum/core/error.hpp>
#include "harness/environment/machine.hpp"
#include "harness/plan/words.hpp"
#include "harness/run/by_ranks.hpp"
#include "harness/run/estimate.hpp"
#include "harness/run/launch.hpp"
#include "harness/terminal/program.hpp"

namespace pairsum::harness {
namespace {

/// What a job asks Slurm for.
struct wanted {
  int nodes = 1, ranks = 1;
  int units = 1;    ///< for each rank, where there are most of them
  int threads = 1;  ///< most that one rank has
  bool evolves = false;
};

int divided_up(int a, int b) { return (a + b - 1) / b; }

/// @param cores of a node
wanted wants_of(const study_plan& plan, const registry& all, int cores) {
  wanted w;
  int together = 1;
  for (const part_plan& part : plan.parts)
    for (const world_plan& points : expand(part.request, all))
      for (const point& p : points) {
        const int ranks_of_a_node = std::max(1, cores / p.threads);
        w.nodes = std::max(w.nodes, divided_up(p.ranks, ranks_of_a_node));
        w.ranks = std::max(w.ranks, p.ranks);
        w.threads = std::max(w.threads, p.threads);
        together = std::max(together, p.ranks * p.threads);
        w.evolves = w.evolves || evolved_time(p.state);
      }
  w.units = divided_up(together, w.ranks);
  return w;
}

/// Minutes that the job may take, with what they come from.
std::pair<int, std::string> time_of(const study_plan& plan, const registry& all) {
  constexpr double minute_s = 60, start_s = 300, budget_margin = 1.1, estimate_margin = 2;
  const auto minutes = [](double seconds) { return static_cast<int>(std::ceil(std::min(seconds, 3e7) / minute_s)); };
  if (plan.budget_s > 0)
    return {minutes(plan.budget_s * budget_margin + start_s),
            fmt::format("the budget of {:.0f} s, and some minutes", plan.budget_s)};
  estimate time(plan, all);
  time.calibrate(all);
  return {minutes(time.all_s() * estimate_margin + start_s),
          fmt::format("twice the estimate of {:.0f} s (on this machine), and some minutes; --budget S limits the study",
                      std::ceil(time.all_s()))};
}

/// A name that needs no quotes.
std::string plain_name(const std::string& name) {
  constexpr std::size_t longest = 60;
  std::string plain = name.substr(0, longest);
  for (char& c : plain)
    if (static_cast<unsigned char>(c) >= 0x80 || (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-'))
      c = '_';
  return plain;
}

std::string directives(const study_plan& plan, const registry& all, const wanted& w, int cores) {
  const auto [minutes, why] = time_of(plan, all);
  std::string text = fmt::format(
      "#SBATCH --job-name=pairsum-{}\n"
      "#SBATCH --output=%x-%j.out\n"
      "# What other jobs do on a node would be in the times: whole nodes, with all their memory.\n"
      "#SBATCH --exclusive\n"
      "#SBATCH --mem=0\n"
      "# Enough nodes of {} core{}, as the machine has on which this script was written. On others,\n"
      "# change the number. Words like all, cores and cores/ranks mean the cores of the job.\n"
      "#SBATCH --nodes={}\n"
      "# The largest number of ranks, and the cores of each.\n"
      "#SBATCH --ntasks={}\n"
      "#SBATCH --cpus-per-task={}\n",
      plain_name(plan.study), cores, cores == 1 ? "" : "s", w.nodes, w.ranks, w.units);
  if (w.threads > cores) text += fmt::format("# One rank has {} threads: its node needs as many cores.\n", w.threads);
  text += fmt::format(
      "# From {}.\n"
      "{}"
      "#SBATCH --time={:02}:{:02}:00\n"
      "# A minute before that the study ends after a step, and keeps its rounds.\n"
      "#SBATCH --signal=B:TERM@60\n"
      "##SBATCH --partition=NAME\n"
      "##SBATCH --account=NAME\n",
      why, w.evolves ? "# States that are stepped to first (evolved:...) take time beside that.\n" : "", minutes / 60,
      minutes % 60);
  return text;
}

/// What starts the ranks.
std::string launcher_text(const std::string& given, int nodes) {
  constexpr const char* whole_job =
      "# With these srun would give few ranks few cores: --cpus-per-task is for the largest number.\n"
      "unset SLURM_CPUS_PER_TASK SLURM_TRES_PER_TASK\n";
  if (!given.empty()) return fmt::format("launcher={}\n{}", shell_word(given), whole_job);
  return fmt::format(
      "# srun starts the ranks if this Slurm speaks PMIx, else the mpirun of the MPI does. pairsum puts\n"
      "# the number of ranks behind, and --cpu-bind=none or --bind-to none: it pins threads by itself,\n"
      "# each on a core of its own. If your MPI takes other words, write them here.\n"
      "if srun --mpi=list 2>&1 | grep -qw pmix; then\n"
      "  launcher='srun --mpi=pmix'\n"
      "else\n"
      "  launcher='mpirun{}'\n"
      "fi\n"
      "{}",
      nodes > 1 ? " --map-by node --rank-by slot" : "", whole_job);
}

}  // namespace

void check_sbatch(const given_options& given) {
  for (const char* const other : {"dry-run", "show-plan"})
    if (given.at(other))
      throw error(fmt::format("--sbatch prints a job script and --{} something else: leave one of them out", other));
  if (given.at("fresh"))
    throw error("--fresh would start over each time that the job of --sbatch is submitted: name a new file with --out");
  if (default_ranks() > 1)
    throw error("--sbatch writes a job, so it starts outside of one: leave mpirun or srun out, and say --ranks");
}

std::string sbatch_script(const study_plan& plan, const registry& all, const sbatch_call& call) {
  const int cores = usable_cores();
  const wanted w = wants_of(plan, all, cores);
  const bool has_launcher = w.ranks > 1 || !call.launcher.empty();
  return fmt::format(
      "#!/bin/bash\n"
      "# A job for Slurm, made by: pairsum {} --sbatch\n"
      "# {}: {}\n"
      "#   sbatch FILE    starts the study, and goes on with it where it was if it was cut.\n"
      "# Rows of two machines never share a file. So what goes on wants the first node it had before:\n"
      "#   sbatch --nodelist=NODE FILE\n"
      "{}\n"
      "# The modules with which pairsum was built, if there are any:\n"
      "# module load gcc openmpi\n\n"
      "cd {} || exit 2\n"
      "{}"
      "# Nothing like OMP_PROC_BIND is needed. exec: the signal above reaches pairsum.\n"
      "exec {} {} \\\n"
      "{}"
      "  --out {}\n",
      call.words, one_line(plan.study), one_line(plan.title), directives(plan, all, w, cores),
      shell_word(call.folder.string()), has_launcher ? launcher_text(call.launcher, w.nodes) : "",
      shell_word(call.program.string()), call.words, has_launcher ? "  --launcher \"$launcher\" \\\n" : "",
      shell_word(call.out));
}

}  // namespace pairsum::harness

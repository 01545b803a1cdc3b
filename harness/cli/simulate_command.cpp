#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include <pairsum/core/error.hpp>
#include "harness/cli/commands.hpp"
#include "harness/cli/profile_levels.hpp"
#include "harness/environment/machine.hpp"
#include "harness/evolve/balance.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/evolve/simulate_registry.hpp"
#include "harness/plan/levels.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/run/by_ranks.hpp"
#include "harness/run/job_launch.hpp"
#include "harness/simulate/simulate.hpp"
#include "harness/terminal/terminal.hpp"

namespace pairsum::harness {
namespace {

constexpr level_option simulate_levels[] = {
    {"case", "dam_break", "initial condition (pairsum list)"},
    {"dx", "0.02", "particle spacing in m"},
    {"state", "rest", "rest, perturbed"},
    {"dim", "3", "dimension"},
    {"H", "0", "support radius in m; 0: 2 dx"},
    {"interaction", "ferrari09_hard", "pair interaction; ferrari09_hard: ferrari09 with walls that hold"},
    {"smoothing", "wendland_c2", "smoothing kernel"},
    {"integrator", "predictor_corrector", "time stepping"},
    {"outside", "drop", "particles that leave Omega: drop (and count), error"},
    {"seed", "1", "of perturbation and random places"},
    {"backend", "sliced_2colour",
     "backend; one with the same bits for every number of threads resumes with the same bits"},
    {"grid", "compact_grid", "grid"},
    {"M", "7", "hash size, for a grid that takes one"},
    {"isa", "default", "scalar, best, avx2, ..."},
    {"block", "auto", "of backends with blocks of cells"},
    {"precision", "double", "working precision"},
    {"threads", "cores/ranks", "number of threads of each rank; cores/ranks: all cores, shared by the ranks"},
    {"granularity", "default", "of loops"},
    {"ranks", "1", "number of ranks of an MPI job, which share the particles"},
    {"cut", "twice", "pairs across ranks: twice: both sum them; once: one does, and sends back"},
};

struct simulate_options {
  std::map<std::string, std::string> levels;
  std::string profile, snapshots, launcher = default_launcher;
  simulate_request request;
  bool oversubscribe = false;
};

std::string percent(double now, double start) {
  return start == 0 ? "-" : fmt::format("{:+.2f} %", 100 * (now - start) / std::abs(start));
}

int start(const simulate_options& o, const given_options& given) {
  simulate_request r = o.request;
  r.levels = levels_of(o.levels, o.profile, given);
  r.snapshots = o.snapshots;
  fmt::print("{}", take_particles(r.levels));
  if (!given.at("ranks")) r.levels.ranks = {default_ranks()};
  if (r.levels.ranks.size() != 1)
    throw error(fmt::format("simulate takes one of each, but --ranks names {}", r.levels.ranks.size()));
  check_request(r.levels, simulate_registry());
  std::vector<int> threads;
  for (const world_plan& points : expand(r.levels, simulate_registry()))
    for (const point& p : points) threads.push_back(p.threads * p.ranks);
  check_cores(threads, o.oversubscribe);
  if (!threads.empty()) {
    const int ranks = r.levels.ranks.front();
    if (const auto code = by_ranks(ranks, o.launcher, threads.front() / ranks)) return *code;
  }
  const bool dim3 = r.levels.dim == 3;
  bool first = true;
  const simulate_result done = simulate(r, [&](const moment& m, const balance& b, double energy_at_start) {
    if (first)
      fmt::print("{:>9} {:>8} {:>10} {:>10} {:>8} {:>8}{} {:>8} {:>8}\n", "t [s]", "steps", "energy [J]", "change",
                 "x to [m]", "y to [m]", dim3 ? " z to [m]" : "", "speed", "lost");
    first = false;
    fmt::print("{:>9.4g} {:>8} {:>10.4g} {:>10} {:>8.4f} {:>8.4f}{} {:>8.3g} {:>8}\n", m.t, m.step, b.energy(),
               percent(b.energy(), energy_at_start), b.high[0], b.high[1],
               dim3 ? fmt::format(" {:>8.4f}", b.high[2]) : "", b.speed, m.lost);
    std::fflush(stdout);
  });
  const std::size_t n = done.end.particles.count(particle_kind::fluid);
  if (done.interrupted) {
    fmt::print("interrupted at t = {:.4g} s; {}\n", done.end.t,
               r.snapshots.empty() ? "nothing was kept: --snapshots DIR keeps checkpoints"
                                   : "the same command goes on from the last checkpoint");
    return 130;
  }
  fmt::print(
      "\n{} {} on {} thread{}: {} fluid particles, {} steps to t = {:g} s in {:.1f} s, {:.3g} us per particle and "
      "step\n",
      done.what.backend, done.what.isa, done.what.threads, done.what.threads == 1 ? "" : "s", n, done.steps, done.end.t,
      done.seconds,
      done.steps == 0 ? 0 : 1e6 * done.seconds / static_cast<double>(done.steps) / static_cast<double>(n));
  if (done.resumed_from > 0) fmt::print("went on from t = {:g} s\n", done.resumed_from);
  fmt::print("lost: {} of {} fluid particles\n", done.end.lost, n + done.end.lost);
  if (!r.snapshots.empty()) fmt::print("snapshots: {}\n", r.snapshots.string());
  return 0;
}

}  // namespace

void add_simulate_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand(
      "simulate",
      "Steps particles through time with any backend, for states that have flowed. Prints energy, extents and losses;\n"
      "keeps snapshots that ParaView opens, a log, and a checkpoint from which the same command goes on.");
  const auto o = std::make_shared<simulate_options>();
  for (const level_option& option : simulate_levels)
    command->add_option(std::string("--") + option.key, o->levels[option.key] = option.standard, option.what)
        ->capture_default_str();
  add_particle_options(*command, o->levels);
  simulate_request& r = o->request;
  command->add_option("--profile", o->profile,
                      "file of pairsum tune: its case and winner where no option says otherwise");
  command->add_option("--until", r.until, "time to end at, s")->capture_default_str();
  command->add_option("--dt", r.rules.dt, "time step, s (default: by --cfl)");
  command->add_option("--cfl", r.rules.cfl, "share of the time step that speed, sound and acceleration allow")
      ->capture_default_str();
  command->add_option("--snapshots", o->snapshots,
                      "folder of snapshots (.hdf), log.csv and checkpoint; made if need be");
  command->add_option("--every", r.every, "time between snapshots, s (default: a twentieth of --until)");
  command->add_option("--checkpoint", r.checkpoint,
                      "time between checkpoints besides the snapshots, s (default: none)");
  command->add_option("--log", r.log, "time between rows of the log, s (default: a two-hundredth of --until)");
  command->add_flag("--fresh", r.fresh, "start over where the folder holds a simulation");
  command->add_option("--binding", r.binding, "cores_first: pins threads, one on every core first; none")
      ->capture_default_str();
  command->add_option("--launcher", o->launcher, "what starts ranks: mpirun, srun, ...")->capture_default_str();
  command->add_flag("--oversubscribe", o->oversubscribe, "allow more threads than the machine has for this job");
  add_plugin_option(*command);
  command->footer(
      "Examples:\n"
      "  pairsum simulate --dim 2 --dx 0.006 --until 1 --snapshots dam\n"
      "  pairsum simulate --profile tune.profile.json --until 0.5\n"
      "A state to measure on, made once and kept: pairsum run --state evolved:0.5");
  command->callback([&chosen, o, command] {
    const given_options given = given_of(*command);
    chosen = [o, given] { return start(*o, given); };
  });
}

}  // namespace pairsum::harness

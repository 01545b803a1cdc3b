#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/error.hpp"
#include "harness/cli/commands.hpp"
#include "harness/environment/machine.hpp"
#include "harness/plan/words.hpp"
#include "harness/run/runner.hpp"

namespace pairsum::harness {
namespace {

struct run_options {
  run_request request;
  std::string dx = "0.02", state = "rest", backend = "naive_omp,symmetric_omp", M = "6,7", threads = "all",
              order = "lattice", precision = "double", interaction = "ferrari09", smoothing = "wendland_c2",
              integrator = "euler";
  std::string out, results = "results";
  bool out_given = false;
};

int start(const run_options& o) {
  run_request r = o.request;
  r.dx = parse_numbers("--dx", o.dx);
  r.states = parse_words("--state", o.state);
  r.backends = parse_words("--backend", o.backend);
  r.M = parse_counts("--M", o.M, 0);
  r.threads = parse_counts("--threads", o.threads, usable_cores());
  r.orders = parse_words("--order", o.order);
  r.precisions = parse_words("--precision", o.precision);
  r.interactions = parse_words("--interaction", o.interaction);
  r.smoothings = parse_words("--smoothing", o.smoothing);
  r.integrators = parse_words("--integrator", o.integrator);
  check_request(r);
  if (o.out_given && o.out.empty()) throw error("--out takes the name of a file, not \"\"");
  const std::filesystem::path path =
      o.out.empty() ? default_rows_path(o.results, r.study) : std::filesystem::path(o.out);
  const int code = run(r, path);
  fmt::print("rows: {}\n", path.string());
  return code;
}

}  // namespace

void add_run_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand(
      "run",
      "Times backends x M x threads on a case. Every step is verified before its time is written; points are\n"
      "interleaved in a seeded order; one row of JSON per timed step is appended to the rows file.");
  const auto o = std::make_shared<run_options>();
  run_request& r = o->request;
  command->add_option("--study", r.study, "name of the study, a folder under --results")->capture_default_str();
  command->add_option("--case", r.case_name, "initial condition (pairsum list)")->capture_default_str();
  command->add_option("--dx", o->dx, "particle spacing in m, a list; 0.00594 is the talk's 2,014,966 particles")
      ->capture_default_str();
  command->add_option("--state", o->state, "rest, perturbed, or both")->capture_default_str();
  command->add_option("--backend", o->backend, "backends, a list (pairsum list)")->capture_default_str();
  command->add_option("--M", o->M, "hash sizes, like 6,7 or 5..9: the grid is folded to 2^M cells an axis")
      ->capture_default_str();
  command->add_option("--threads", o->threads, "numbers of threads, or all: 1, 2, 4, ... and every core")
      ->capture_default_str();
  command->add_option("--steps", r.steps, "time steps per repetition")->capture_default_str();
  command->add_option("--repetitions", r.repetitions, "repetitions; intervals need at least 6")->capture_default_str();
  command
      ->add_option("--budget", r.budget_s,
                   "stop after the last repetition that fits into so many seconds (0: no limit)")
      ->capture_default_str();
  command->add_option("--dim", r.dim, "dimension")->capture_default_str();
  command->add_option("--H", r.H, "support radius in m (0: 2 dx)")->capture_default_str();
  command->add_option("--precision", o->precision, "working precisions, a list")->capture_default_str();
  command->add_option("--interaction", o->interaction, "pair interactions, a list")->capture_default_str();
  command->add_option("--smoothing", o->smoothing, "smoothing kernels, a list")->capture_default_str();
  command->add_option("--integrator", o->integrator, "time stepping, a list")->capture_default_str();
  command->add_option("--dt", r.dt, "time step in s")->capture_default_str();
  command->add_option("--grid", r.grid, "grid")->capture_default_str();
  command->add_option("--order", o->order, "orders of memory at the start, a list: lattice, shuffled, morton")
      ->capture_default_str();
  command->add_option("--outside", r.outside, "particles outside Omega: error or drop")->capture_default_str();
  command->add_option("--seed", r.seed, "of the perturbation, of random places and of the order of measuring")
      ->capture_default_str();
  command->add_option("--out", o->out,
                      "rows file; appended to if it exists (default: RESULTS/STUDY/HOST-UTC-GIT.jsonl)");
  command->add_option("--results", o->results, "folder of the default rows file")->capture_default_str();
  command->footer(
      "Example, the talk's headline:\n"
      "  pairsum run --study talk --dx 0.00594 --backend naive_omp,symmetric_omp --M 6,7 --threads all --steps 5");
  command->callback([&chosen, o, command] {
    o->out_given = command->count("--out") > 0;
    chosen = [o] { return start(*o); };
  });
}

}  // namespace pairsum::harness

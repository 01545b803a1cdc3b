#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "harness/cli/commands.hpp"
#include "harness/environment/machine.hpp"
#include "harness/measure/memory.hpp"
#include "harness/plan/plan.hpp"
#include "harness/plan/words.hpp"
#include "harness/verify/verify_all.hpp"

namespace pairsum::harness {
namespace {

struct verify_options {
  run_request request;
  std::string dx = "0.04", state = "perturbed", backend = "all", interaction = "all", M = "2,3,6,7",
              threads = "1,2,3,7";
};

int verify(verify_options o) {
  const registry& r = registry::instance();
  run_request& q = o.request;
  q.dx = parse_numbers("--dx", o.dx);
  q.states = parse_words("--state", o.state);
  q.M = parse_counts("--M", o.M, 0);
  q.threads = parse_counts("--threads", o.threads, usable_cores());
  verify_plan plan;
  if (o.backend == "all")
    for (const backend_entry& b : r.backends()) {
      if (b.unavailable.empty()) plan.backends.emplace_back(b.traits.name);
    }
  else
    plan.backends = parse_words("--backend", o.backend);
  q.backends = plan.backends;
  plan.interactions = o.interaction == "all" ? r.interactions() : parse_words("--interaction", o.interaction);
  for (const std::string& i : plan.interactions) {
    q.interaction = i;
    check_request(q);
  }
  plan.M = q.M;
  plan.threads = q.threads;
  plan.base.smoothing = q.smoothing;
  plan.base.precision = q.precision;
  plan.base.grid = q.grid;
  plan.base.dim = q.dim;
  keep_freed_memory();
  bool ok = true;
  std::size_t lines = 0, failed = 0;
  for (const double dx : q.dx)
    for (const std::string& state : q.states) {
      const initial_condition c = make_case(q.case_name, {q.dim, dx, q.H, state, q.seed});
      fmt::print("{} dx={} {}: {} fluid, {} boundary particles\n", q.case_name, dx, state,
                 c.particles.count(particle_kind::fluid), c.particles.count(particle_kind::boundary));
      fmt::print("{:<12}{:<16}{:>4}{:>9}   {}\n", "interaction", "backend", "M", "threads", "largest error / bound");
      ok = verify_all(r, c, plan,
                      [&](const verify_line& l) {
                        ++lines;
                        failed += !l.ok;
                        fmt::print("{:<12}{:<16}{:>4}{:>9}   {}\n", l.interaction, l.backend, l.M, l.threads,
                                   l.ok ? fmt::format("{:.3g}", l.share) : "FAILED: " + l.error);
                        std::fflush(stdout);
                      }) &&
           ok;
    }
  fmt::print("{} of {} sums agree with the reference\n", lines - failed, lines);
  return ok ? 0 : 1;
}

}  // namespace

void add_verify_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand(
      "verify",
      "Sums a case with every backend, M and number of threads, and compares each rate with a reference\n"
      "that shares no grid, sort or loop with them. The bound comes from running error analysis of the formula.");
  const auto o = std::make_shared<verify_options>();
  command->add_option("--case", o->request.case_name, "initial condition")->capture_default_str();
  command->add_option("--dx", o->dx, "particle spacing in m, a list")->capture_default_str();
  command->add_option("--state", o->state, "rest, perturbed, or both; in rest many terms are zero")
      ->capture_default_str();
  command->add_option("--backend", o->backend, "backends, or all")->capture_default_str();
  command->add_option("--interaction", o->interaction, "interactions, or all")->capture_default_str();
  command->add_option("--M", o->M, "hash sizes, like 2,3 or 5..9")->capture_default_str();
  command->add_option("--threads", o->threads, "numbers of threads, or all")->capture_default_str();
  command->add_option("--precision", o->request.precision, "working precision")->capture_default_str();
  command->add_option("--smoothing", o->request.smoothing, "smoothing kernel")->capture_default_str();
  command->add_option("--dim", o->request.dim, "dimension")->capture_default_str();
  command->add_option("--seed", o->request.seed, "of the perturbation")->capture_default_str();
  command->callback([&chosen, o] { chosen = [o] { return verify(*o); }; });
}

}  // namespace pairsum::harness

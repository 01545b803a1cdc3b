#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>

#include <pairsum/core/error.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/sum/grids.hpp>
#include "harness/cli/commands.hpp"
#include "harness/cli/profile_levels.hpp"
#include "harness/cli/verify_report.hpp"
#include "harness/environment/machine.hpp"
#include "harness/evolve/initial_of.hpp"
#include "harness/measure/memory.hpp"
#include "harness/plan/levels.hpp"
#include "harness/plan/plan.hpp"
#include "harness/plan/variants.hpp"
#include "harness/plan/words.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/ranks/crew.hpp"
#include "harness/run/by_ranks.hpp"
#include "harness/run/job_launch.hpp"
#include "harness/run/point_setup.hpp"
#include "harness/verify/verify_all.hpp"

namespace pairsum::harness {
namespace {

struct verify_options {
  run_request request;
  std::string case_name, dx, state = "perturbed", dim = "all", precision = "all", interaction = "all",
                             smoothing = "all", backend = "all", grid = "all", isa = "scalar,best", block = "auto",
                             M = "2,3,6,7", threads = "1,2,3,7", ranks = "1", cut = "twice", seed = "1",
                             launcher = default_launcher;
  std::map<std::string, std::string> of_files;
  bool each = false, all_M = true, json = false;
};

/// The words of an option; "all" stands for `every`.
std::vector<std::string> words_or_all(const std::string& option, const std::string& text,
                                      const std::vector<std::string>& every) {
  return text == "all" ? every : parse_words(option, text);
}

std::vector<std::string> to_words(const std::vector<std::string_view>& names) { return {names.begin(), names.end()}; }

/// The request in one dimension: a case that exists there, a spacing for about 3000 fluid particles, and without the
/// words that nobody asked for by name and that are not built there.
run_request in_dimension(int dim, const run_request& asked, const verify_options& o, const registry& r) {
  run_request q = asked;
  q.dim = dim;
  if (q.particles.empty()) q.case_name = !o.case_name.empty() ? o.case_name : dim == 1 ? "lattice" : "dam_break";
  if (o.dx.empty() && q.particles.empty()) q.dx = {dim == 1 ? 0.0005 : dim == 2 ? 0.01 : 0.04};
  if (o.precision == "all") leave_out_unbuilt(q, &run_request::precisions, r);
  if (o.interaction == "all") leave_out_unbuilt(q, &run_request::interactions, r);
  if (o.smoothing == "all") leave_out_unbuilt(q, &run_request::smoothings, r);
  return q;
}

/// Of the M that nobody asked for, a periodic box has those whose torus closes where it does. Which these are depends
/// on a backend's skin: returns the request in parts, of backends that take the same M. Where none fits only grids
/// without M are left.
std::vector<run_request> parts_with_M_that_fit(const run_request& q, const initial_condition& c) {
  if (!c.periodic.any()) return {q};
  std::map<std::vector<int>, std::vector<std::string>> backends;
  for (const std::string& b : q.backends) {
    std::vector<int> fitting = q.M;
    std::erase_if(fitting, [&](int M) { return !M_fits(M, b, c, registry::instance()); });
    backends[fitting].push_back(b);
  }
  std::vector<run_request> parts;
  for (const auto& [M, those] : backends) {
    run_request part = q;
    part.backends = those;
    if (M.empty())
      std::erase_if(part.grids, grid_takes_M);
    else
      part.M = M;
    if (!part.grids.empty()) parts.push_back(part);
  }
  if (parts.empty()) throw error("no hashed grid goes round the periodic box: take --grid dense_grid,compact_grid");
  return parts;
}

int verify(const verify_options& o) {
  const registry& r = registry::instance();
  run_request q = o.request;
  if (!o.dx.empty()) q.dx = parse_numbers("--dx", o.dx);
  q.seed = parse_seed("--seed", o.seed);
  q.states = parse_words("--state", o.state);
  q.M = parse_counts("--M", o.M, 0);
  q.threads = parse_counts("--threads", o.threads, usable_cores());
  q.ranks = parse_counts("--ranks", o.ranks == "1" ? std::to_string(default_ranks()) : o.ranks, 0);
  if (q.ranks.size() > 1) throw error(fmt::format("verify takes one number of ranks, not \"{}\"", o.ranks));
  q.cuts = parse_words("--cut", o.cut);
  q.backends = words_or_all("--backend", o.backend, available_backends(r));
  q.precisions = words_or_all("--precision", o.precision, r.precisions());
  q.interactions = words_or_all("--interaction", o.interaction, r.interactions());
  q.smoothings = words_or_all("--smoothing", o.smoothing, r.smoothings());
  if (q.smoothings.empty()) q.smoothings = {std::string(no_smoothing)};
  q.grids = words_or_all("--grid", o.grid, to_words(grid_names()));
  std::vector<std::string> isas = to_words(isa_names());
  isas.insert(isas.begin(), std::string(scalar_isa));
  q.isas = words_or_all("--isa", o.isa, isas);
  q.blocks = parse_words("--block", o.block);
  std::vector<int> dims = o.dim == "all" ? r.dims() : parse_counts("--dim", o.dim, 0);
  for (const auto& [key, text] : o.of_files)
    if (!text.empty()) read_level(q, key, text, 0, option_of(key));
  std::string particles;
  if (!q.particles.empty()) {
    if (!o.case_name.empty() || !o.dx.empty())
      throw error("--case and --dx are about a case, and --particles names files");
    if (o.dim != "all") q.hints["file_dim"] = o.dim;
    q.states = {o.state == "perturbed" ? std::string(state_of_files) : o.state};
    particles = take_particles(q);
    dims = {q.dim};
  }
  if (o.dim == "all" && q.particles.empty())
    for (const case_entry& c : case_entries())
      if (c.name == o.case_name) std::erase_if(dims, [&](int dim) { return dim < c.least_dim; });
  std::vector<run_request> requests;
  for (const int dim : dims) {
    const run_request here = in_dimension(dim, q, o, r);
    if (o.dim == "all" && expand(here, r).empty() && (dim != dims.back() || !requests.empty())) continue;
    check_request(here);
    requests.push_back(here);
  }
  if (const auto code = by_ranks(q.ranks.front(), o.launcher, *std::ranges::max_element(q.threads))) return *code;
  keep_freed_memory();
  verify_report report(o.each, o.json);
  fmt::print(line_stream(o.json), "{}", particles);
  for (const run_request& there : requests) {
    for (const double dx : there.dx)
      for (const std::string& state : there.states) {
        initial_condition c;
        pairsum::harness::here().in_turn([&] { c = initial_of(there, dx, state).initial; });
        report.begin(there.case_name, dx, state, c);
        run_request here = there;
        here.dx = {dx};
        here.states = {state};
        fmt::print(line_stream(o.json), "{}", leave_out(here, wide_skins(c, r), r));
        for (const run_request& part : o.all_M ? std::vector{here} : parts_with_M_that_fit(here, c))
          verify_all(r, c, verify_plan_of(part, r), [&](const verify_line& l) { report.add(l); });
      }
  }
  return report.end() ? 0 : 1;
}

}  // namespace

void add_verify_command(CLI::App& app, action& chosen) {
  CLI::App* const command = app.add_subcommand(
      "verify",
      "Sums a case with every formula, backend, grid, M and number of threads, and compares each rate with a "
      "reference\n"
      "that shares no grid, sort or loop with them. The bound comes from running error analysis of the formula.");
  const auto o = std::make_shared<verify_options>();
  command->add_option("--case", o->case_name, "initial condition (default: dam_break, in 1D lattice)");
  command->add_option("--dx", o->dx, "particle spacing in m, a list (default: about 3000 fluid particles)");
  command->add_option("--state", o->state, "rest, perturbed, or both; in rest many terms are zero")
      ->capture_default_str();
  command->add_option("--backend", o->backend, "backends, or all")->capture_default_str();
  command->add_option("--interaction", o->interaction, "interactions, or all that are built")->capture_default_str();
  const auto* const M = command
                            ->add_option("--M", o->M,
                                         "hash sizes, like 2,3 or 5..9; of the default a periodic box "
                                         "takes those that go round it")
                            ->capture_default_str();
  command->add_option("--grid", o->grid, "grids, or all")->capture_default_str();
  command->add_option("--isa", o->isa, "scalar, best, default, instruction sets, or all of this build and machine")
      ->capture_default_str();
  command->add_option("--block", o->block, "blocks of backends that have some, a list: auto, slab:4, ...")
      ->capture_default_str();
  command->add_option("--threads", o->threads, "numbers of threads, or all")->capture_default_str();
  command->add_option("--ranks", o->ranks, "of an MPI job that sums together")->capture_default_str();
  command->add_option("--cut", o->cut, "pairs across ranks are summed: twice, once")->capture_default_str();
  command->add_option("--launcher", o->launcher, "what starts ranks: mpirun, srun, ...")->capture_default_str();
  command->add_option("--precision", o->precision, "working precisions, or all that are built")->capture_default_str();
  command->add_option("--smoothing", o->smoothing, "smoothing kernels, or all that are built")->capture_default_str();
  command->add_option("--dim", o->dim, "dimensions, or all that are built")->capture_default_str();
  command->add_option("--seed", o->seed, "of the perturbation and of random places")->capture_default_str();
  command->add_flag("--each", o->each, "a line per sum, not per formula");
  command->add_flag("--json", o->json, "the sums as one JSON document on stdout, the lines on stderr");
  command->add_option("--H", o->of_files["H"], "support radius in m (default: 2 dx, or what files of particles say)");
  add_particle_options(*command, o->of_files);
  add_plugin_option(*command);
  command->callback([&chosen, o, M] {
    o->all_M = M->count() > 0;
    chosen = [o] { return verify(*o); };
  });
}

}  // namespace pairsum::harness

// Runs backends for the race detector to watch. Exit status: 0, 2 for bad use, the detector's own if it reports a race.
//
//   race_main omp|tbb       the library's backends with these threads, scalar and on vector units
//   race_main BACKEND ISA   a backend with a race on purpose
//   race_main ranks ...     omp or a backend with a race, in each rank of a job that mpirun started
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/error.hpp>
#include <pairsum/core/isa.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/ranks/job.hpp>
#include <pairsum/ranks/ranked.hpp>
#include <pairsum/sum/registry.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "planted.hpp"

namespace pairsum::races {
namespace {

constexpr int threads = 4;

/// The job, if there are ranks.
std::unique_ptr<ranks::job> job;

/// A summation on this process, or on all ranks, with ghosts that have rates where the backend can give them any.
std::unique_ptr<summation> made(const registry& all, const setup& s) {
  auto alone = all.make_summation(s);
  if (job == nullptr) return alone;
  const cut_pairs pairs = alone->traits().symmetric ? cut_pairs::once : cut_pairs::twice;
  return ranks::make_ranked(std::move(alone), {.pairs = pairs});
}

/// Particles and a grid. Enough fluid (104 thousand particles in dam_break) that threads meet: with a few thousand,
/// real races stay unseen.
struct trial {
  const char* case_name;
  double dx;          ///< m
  int M;              ///< 0: dense_grid
  double narrow = 0;  ///< H that the first axis is pressed to; 0: none
};
/// M = 5 folds the tank's boundary onto the fluid, M = 4 the fluid onto itself. M = 2, the smallest torus, tests a
/// fifth of all N^2 pairs and so has to do with fewer particles. Around 3 cells blocks have three colours.
constexpr trial trials[] = {
    {"dam_break", 0.0126, 5}, {"dam_break", 0.025, 4}, {"lattice", 0.05, 2}, {"periodic_lattice", 0.03, 0, 3.5}};

/// The world of a trial, made once for all backends.
struct world {
  explicit world(const trial& w)
      : of(w),
        start(make_case(w.case_name, {.dx = w.dx, .state = "perturbed"})),
        order(memory_order("shuffled", start, 1)) {
    if (w.narrow == 0) return;
    start.omega_high[0] = w.narrow * start.H;
    for (double& x : start.particles.x[0]) x *= start.omega_high[0];
  }
  trial of;
  initial_condition start;
  std::vector<std::uint32_t> order;
};

/// Two steps in which every phase is parallel, from particles in random order, so long that they change cells and some
/// leave Omega. Names each phase on stderr when it begins, so that a report can be told where it belongs.
void run(const registry& all, const world& w, std::string_view backend, std::string_view isa, const team& t) {
  setup s = setup_of(w.start);
  s.backend = backend;
  s.isa = isa;
  s.M = w.of.M;
  if (s.M == 0) s.grid = "dense_grid";

  const auto summation = made(all, s);
  const auto says = [&](const char* phase) {
    std::fprintf(stderr, "race_main: %s %s phase %s\n", s.backend.c_str(), s.isa.c_str(), phase);
  };
  says("load");
  summation->load(w.start.particles, w.order, t);
  const auto evaluate = [&] {
    says("index");
    summation->index(t);
    says("prepare");
    summation->prepare(t);
    says("zero");
    summation->zero(t);
    says("sum");
    summation->sum(t);
    says("reduce");
    summation->reduce(t);
    says("integrate");
  };
  constexpr double dt = 0.01;  // s: a particle moves by about its spacing
  for (int step = 0; step < 2; ++step) find_integrator("euler").step(*summation, dt, w.start.gravity, evaluate, t);

  std::printf("race_main: %s %s %s M=%d: %zu fluid particles, %zu lost\n", s.backend.c_str(), s.isa.c_str(),
              w.of.case_name, w.of.M, w.start.particles.count(particle_kind::fluid), summation->lost());
  std::fflush(stdout);
}

void run_library(runtime r) {
  const registry& all = registry::instance();
  const workers w(r, threads);
  const std::vector<world> worlds(std::begin(trials), std::end(trials));
  for (const backend_entry& b : all.backends()) {
    if (b.traits.threads != r) continue;
    for (const world& one : worlds) run(all, one, b.traits.name, scalar_isa, w.get());
    // What the grid folds is one matter, vector units another. Atomic additions have none.
    if (b.traits.conflicts != conflict_avoidance::atomics) run(all, worlds[0], b.traits.name, best_isa, w.get());
  }
}

/// Colours, locks and buffers; on vector units one.
void run_on_ranks() {
  const registry& all = registry::instance();
  const workers w(runtime::omp, threads);
  const world one(trials[0]);
  for (const char* backend : {"symmetric_omp", "sliced_locks", "touched_blocks"})
    run(all, one, backend, scalar_isa, w.get());
  run(all, one, "symmetric_omp", best_isa, w.get());
}

void run_planted(std::string_view name, std::string_view isa) {
  registry all = registry::instance();
  for (const backend_entry& planted : planted_backends()) all.add(planted);
  const workers w(all.find_backend(std::string(name)).traits.threads, threads);
  run(all, world(trials[0]), name, isa, w.get());
}

int main_of(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "ranks") {
    job = std::make_unique<ranks::job>();
    --argc, ++argv;
  }
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (argc == 2 && first == "omp")
    job != nullptr ? run_on_ranks() : run_library(runtime::omp);
  else if (argc == 2 && first == "tbb")
    run_library(runtime::tbb);
  else if (argc == 3)
    run_planted(first, argv[2]);
  else
    throw error("usage: race_main [ranks] omp|tbb | BACKEND ISA");
  job.reset();
  std::printf("race_main: done\n");
  return 0;
}

}  // namespace
}  // namespace pairsum::races

int main(int argc, char** argv) try { return pairsum::races::main_of(argc, argv); } catch (const std::exception& e) {
  std::fprintf(stderr, "race_main: %s\n", e.what());
  return 2;
}

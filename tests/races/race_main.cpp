// Runs one backend, of the library or a planted one, for the race detector to watch: race_main BACKEND ISA...
// Exit status: 0, 2 for bad use, the detector's own if it reports a race.
#include <cstdio>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/error.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/sum/registry.hpp>
#include "planted.hpp"

namespace pairsum::races {
namespace {

constexpr int threads = 4;

/// Particles and a grid. Enough fluid (104 thousand particles in dam_break) that threads meet: with a few thousand,
/// real races stay unseen.
struct trial {
  const char* case_name;
  double dx;  ///< m
  int M;
};
/// M = 5 folds the tank's boundary onto the fluid, M = 4 the fluid onto itself. M = 2, the smallest torus, tests a
/// fifth of all N^2 pairs and so has to do with fewer particles.
constexpr trial trials[] = {{"dam_break", 0.0126, 5}, {"dam_break", 0.025, 4}, {"lattice", 0.05, 2}};

/// Two steps in which every phase is parallel, from particles in random order, so long that they change cells and some
/// leave Omega. Names each phase on stderr when it begins, so that a report can be told where it belongs.
void run(const registry& all, const trial& w, const initial_condition& start, setup s, const team& t) {
  s.M = w.M;
  s.omega_low = start.omega_low;
  s.omega_high = start.omega_high;
  s.constants = {start.H, start.eos};

  const auto summation = all.make_summation(s);
  const auto says = [](const char* phase) { std::fprintf(stderr, "race_main: phase %s\n", phase); };
  says("load");
  summation->load(start.particles, memory_order("shuffled", start, 1), t);
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
  for (int step = 0; step < 2; ++step) find_integrator("euler").step(*summation, dt, start.gravity, evaluate, t);

  std::printf("race_main: %s %s %s M=%d: %zu fluid particles, %zu lost\n", s.backend.c_str(),
              std::string(summation->isa()).c_str(), w.case_name, w.M, start.particles.count(particle_kind::fluid),
              summation->lost());
  std::fflush(stdout);
}

int main_of(int argc, char** argv) {
  if (argc < 3) throw error("usage: race_main BACKEND ISA...");
  registry all = registry::instance();
  for (const backend_entry& planted : planted_backends()) all.add(planted);
  setup s;
  s.backend = argv[1];
  const workers team_of(all.find_backend(s.backend).traits.threads, threads);
  for (const trial& w : trials) {  // all on the first instruction set; what the grid folds is one matter, lanes another
    const initial_condition start = make_case(w.case_name, {.dx = w.dx, .state = "perturbed"});
    for (int k = 2; k < (&w == trials ? argc : 3); ++k) {
      s.isa = argv[k];
      run(all, w, start, s, team_of.get());
    }
  }
  std::printf("race_main: %s done\n", argv[1]);
  return 0;
}

}  // namespace
}  // namespace pairsum::races

int main(int argc, char** argv) try { return pairsum::races::main_of(argc, argv); } catch (const std::exception& e) {
  std::fprintf(stderr, "race_main: %s\n", e.what());
  return 2;
}

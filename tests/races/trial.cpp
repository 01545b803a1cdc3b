#include "trial.hpp"

#include <cstdio>

#include "cases/case.hpp"
#include "cases/dam_break.hpp"
#include "cases/lattice.hpp"
#include "integrators/euler.hpp"

namespace pairsum {

/// Stands in for the list that the build generates, so that the race tests need to compile only
/// what they run.
const std::vector<case_entry>& case_entries() {
  static const std::vector<case_entry> all{case_entry::of<dam_break>(), case_entry::of<lattice>()};
  return all;
}

namespace races {

void run(const contender& c, const trial& w, int threads) {
  const initial_condition start = make_case(w.case_name, {.dx = w.dx, .state = "perturbed"});
  setup s;
  s.M = w.M;
  s.omega_low = start.omega_low;
  s.omega_high = start.omega_high;
  s.constants = {start.H, start.eos};

  const auto summation = c.make(s);
  summation->load(start.particles, memory_order("shuffled", start, 1));
  const team t = team::omp(threads);
  const auto says = [](const char* phase) { std::fprintf(stderr, "race_main: phase %s\n", phase); };
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
  for (int step = 0; step < w.steps; ++step) euler::step(*summation, dt, start.gravity, evaluate, t);

  std::printf("race_main: %s %s M=%d: %zu fluid particles, %d threads, %d steps, %zu lost\n", c.name.data(),
              w.case_name.c_str(), w.M, start.particles.count(particle_kind::fluid), threads, w.steps,
              summation->lost());
  std::fflush(stdout);
}

}  // namespace races
}  // namespace pairsum

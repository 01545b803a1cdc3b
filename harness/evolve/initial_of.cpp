#include "harness/evolve/initial_of.hpp"

#include <fmt/format.h>

#include <pairsum/core/error.hpp>
#include "harness/evolve/evolved.hpp"
#include "harness/evolve/particles_of_files.hpp"
#include "harness/plan/words.hpp"

namespace pairsum::harness {

std::string take_particles(run_request& r) {
  if (r.particles.empty()) return "";
  const particles_of_request read = particles_of_files(r);
  if (!r.particles_hash.empty() && r.particles_hash != read.hash)
    throw error(fmt::format("other particles than when the plan was made are in {}: {}, not {}",
                            fmt::join(r.particles, ", "), read.hash, r.particles_hash));
  r.case_name = case_of_files;
  if (r.states == std::vector<std::string>{"rest"}) r.states = {std::string(state_of_files)};
  r.dim = read.initial.particles.dim;
  r.dx = {read.dx};
  r.particles_hash = read.hash;
  return table_of(read);
}

particles_of_request initial_of(const run_request& r, double dx, std::string_view state) {
  if (!r.particles.empty()) {
    particles_of_request read = particles_of_files(r);
    if (!r.particles_hash.empty() && r.particles_hash != read.hash)
      throw error(fmt::format("{} changed while the study ran", fmt::join(r.particles, ", ")));
    if (state == "perturbed") perturb(read.initial, dx, r.seed);
    return read;
  }
  const case_parameters words{r.dim, dx, r.H, std::string(state), r.seed};
  if (const auto time = evolved_time(state)) return evolved(r.case_name, words, *time);
  return {.initial = make_case(r.case_name, words), .dx = dx};
}

}  // namespace pairsum::harness

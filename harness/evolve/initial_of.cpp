#include "harness/evolve/initial_of.hpp"

#include "harness/evolve/evolved.hpp"
#include "harness/plan/words.hpp"

namespace pairsum::harness {

particles_of_request initial_of(const run_request& r, double dx, std::string_view state) {
  const case_parameters words{r.dim, dx, r.H, std::string(state), r.seed};
  if (const auto time = evolved_time(state)) return evolved(r.case_name, words, *time);
  return {make_case(r.case_name, words), ""};
}

}  // namespace pairsum::harness

#pragma once
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include <pairsum/sum/summation.hpp>

namespace pairsum {

/// One time step of dt (s) under gravity (m/s2, along -y, in 1D along -x). `evaluate` runs F for the current state: the
/// caller's, who may time its phases. Interactions without drho and dv are evaluated and nothing moves.
using step_function = void (*)(summation& s, double dt, double gravity, const std::function<void()>& evaluate,
                               const team& t);

struct integrator_entry {
  std::string_view name, description;
  step_function step;

  template <class Integrator>
  static integrator_entry of() {
    return {Integrator::name, Integrator::description, &Integrator::step};
  }
};

/// All integrators, in the order of kernels/registry.def.
const std::vector<integrator_entry>& integrator_entries();

/// The integrator of that name; an error lists the valid ones.
const integrator_entry& find_integrator(std::string_view name);

}  // namespace pairsum

/// Makes the struct `word` an integrator that kernels/registry.def may name.
#define PAIRSUM_INTEGRATOR(word)                                            \
  namespace pairsum::integrators_of {                                       \
  integrator_entry word() { return integrator_entry::of<pairsum::word>(); } \
  }

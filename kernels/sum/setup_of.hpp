#pragma once
#include <pairsum/cases/case.hpp>
#include <pairsum/sum/setup.hpp>

namespace pairsum {

/// The domain of a case: Omega, dimension and constants; the words are left at their defaults.
inline setup setup_of(const initial_condition& c) {
  setup s;
  s.dim = c.particles.dim;
  s.omega_low = c.omega_low;
  s.omega_high = c.omega_high;
  s.periodic = c.periodic;
  s.constants = {c.H, c.eos};
  return s;
}

}  // namespace pairsum

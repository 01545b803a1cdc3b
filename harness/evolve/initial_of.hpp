#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/cases/case.hpp>
#include "harness/plan/plan.hpp"

namespace pairsum::harness {

/// The particles that a request sums, and where they come from.
struct particles_of_request {
  initial_condition initial;
  double dx = 0;                                    ///< m, the spacing of files' particles
  std::string hash{};                               ///< 16 hex digits of what no case makes; "" of a case
  std::vector<std::string> files{};                 ///< that were read
  std::vector<std::array<std::string, 4>> facts{};  ///< of particles with a hash: see particles_row
};

/// Takes over what the request's particle files say: dimension and spacing, the words for case and state, and the hash
/// by which a worker knows that it reads the same. Does nothing without files. Throws pairsum::error.
/// @return what was read, given, derived and assumed, as a table; empty without files
std::string take_particles(run_request& r);

/// The particles of a request in one of its states: of its case as made, stepped to a time (evolved:T), or those of
/// its files. Throws pairsum::error.
particles_of_request initial_of(const run_request& r, double dx, std::string_view state);

}  // namespace pairsum::harness

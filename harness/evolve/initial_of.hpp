#pragma once
#include <string>
#include <string_view>

#include <pairsum/cases/case.hpp>
#include "harness/plan/plan.hpp"

namespace pairsum::harness {

/// The particles that a request sums, and where they come from.
struct particles_of_request {
  initial_condition initial;
  std::string hash;  ///< 16 hex digits of what is no case: of evolved states; else empty
};

/// The particles of a request in one of its states: of its case as made, or stepped to a time (evolved:T). Throws
/// pairsum::error.
particles_of_request initial_of(const run_request& r, double dx, std::string_view state);

}  // namespace pairsum::harness

#pragma once
#include <string>
#include <vector>

#include "harness/plan/plan.hpp"

namespace pairsum::harness {

/// A grid with its M; 0 for a grid that takes none.
struct cell_grid {
  std::string name;
  int M = 0;
  bool operator==(const cell_grid&) const = default;
};

/// The request's grids, each with every M, those that take none once.
std::vector<cell_grid> grids_of(const run_request& r);

/// A backend with the isa and the block that it uses.
struct backend_way {
  std::string backend, isa, block;
  bool operator==(const backend_way&) const = default;
};

/// The backends that this build has and the machine lets it use.
std::vector<std::string> available_backends(const registry& all = registry::instance());

/// Every variant in which the request's backends sum a world: with each isa available in it, and with each block if
/// they have blocks. Throws pairsum::error for a backend that is unknown or unavailable.
std::vector<backend_way> ways_of(const run_request& r, const point& world, const registry& all);

/// Leaves out the precisions, interactions or smoothing kernels that none of the request's backends was built for
/// together with its other words: those that the user did not name. If there are no others they stay, and check_built()
/// says what is wrong.
void leave_out_unbuilt(run_request& r, std::vector<std::string> run_request::*words, const registry& all);

/// Leaves out every word that is known but that this build or this machine does not have, and returns why, a line each
/// once. Throws pairsum::error for a word that is unknown. If nothing is left to measure, the request has no backend.
std::vector<std::string> leave_out_unavailable(run_request& r, const registry& all);

/// Throws pairsum::unavailable for a precision, interaction or smoothing kernel that none of the request's backends was
/// built for with any of its others; combinations that were not built are left out.
void check_built(const run_request& r, const registry& all);

}  // namespace pairsum::harness

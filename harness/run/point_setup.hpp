#pragma once
#include <pairsum/cases/case.hpp>
#include <pairsum/sum/registry.hpp>
#include "harness/plan/plan.hpp"
#include "harness/rows/row.hpp"
#include "harness/verify/verify_all.hpp"

namespace pairsum::harness {

/// The setup that a point's words name, in the world of a case, on this machine.
setup setup_of_point(const point& p, const initial_condition& c);

/// Can a hashed grid with this M be had in the world of a case for the backend, with its skin? In a periodic box the
/// torus must close where the box does.
bool M_fits(int M, const std::string& backend, const initial_condition& c, const registry& all);

/// Every sum that the points of a request make, of one dx and state.
verify_plan verify_plan_of(const run_request& r, const registry& all);

}  // namespace pairsum::harness

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

/// The backends whose cells, with their skin, the periodic box of a case has no room for.
std::vector<std::string> wide_skins(const initial_condition& c, const registry& all);

/// Takes backends out of a request of all of them, which nobody named one by one, and with them those that are not
/// built for it. Other requests stay as they are.
/// @return a line that says which; empty if there are none to take out
std::string leave_out(run_request& r, const std::vector<std::string>& backends, const registry& all);

/// Both, for all worlds of a request. What is wrong with these is said where they are checked.
std::string leave_out_wide_skins(run_request& r, const registry& all);

/// Every sum that the points of a request make, of one dx and state.
verify_plan verify_plan_of(const run_request& r, const registry& all);

}  // namespace pairsum::harness

#pragma once
#include <pairsum/sum/registry.hpp>
#include "harness/run/order.hpp"

namespace pairsum::harness {

/// Carries out an order in this process and appends its rows. A round: the particles are made, every backend is warmed
/// up by one step, then the points of all worlds are measured interleaved, in an order that seed, round and repetition
/// decide; every step is verified before its row is written. Returns the exit code: 0, 1 if a point failed its
/// verification, 130 after SIGINT or SIGTERM (rows up to there are written). Throws pairsum::error for bad input.
int carry_out(const order& o, const registry& all);

/// In a self-test, the corrupt backends are right if they are refused.
bool must_fail(const study_plan& plan, const std::string& backend);

/// The backends that a plan may name: those of the build, and with `self_test` those that test the harness.
const registry& registry_of(const study_plan& plan);

}  // namespace pairsum::harness

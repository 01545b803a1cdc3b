#pragma once
#include <string>

#include "harness/plan/study.hpp"

namespace pairsum::harness {

/// The design of a plan in words: per part its reason, levels, points and rounds, about how long it takes, from a small
/// sum that is made for it on this machine, and what this build or this machine cannot measure of it, with the reason.
/// Throws pairsum::error for a plan that no build can measure.
std::string dry_run(const study_plan& plan, const registry& all);

}  // namespace pairsum::harness

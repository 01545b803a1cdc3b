#pragma once
#include <string>

#include "harness/plan/study.hpp"

namespace pairsum::harness {

/// The design of a plan in words: per part its reason, levels, points and rounds, and about how long it takes, from a
/// small sum that is made for it on this machine.
std::string dry_run(const study_plan& plan, const registry& all);

}  // namespace pairsum::harness

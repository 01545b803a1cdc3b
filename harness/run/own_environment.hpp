#pragma once
#include <string>

#include "harness/plan/study.hpp"
#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// This machine and build, with threads bound as `binding` says.
environment_row own_environment(const study_plan& plan, const std::string& binding);

}  // namespace pairsum::harness

#pragma once
#include <string>
#include <vector>

#include "harness/plan/study.hpp"

namespace pairsum::harness {

/// Leaves those values of a plan's levels that `only` names, each like "backend=naive,naive_omp"; the same level may be
/// named several times. Parts that have none of them are left out. Throws pairsum::error for a level or a value that no
/// part has, naming those it has, and if no part is left.
/// @param cores what "all" and "cores" mean for threads
void narrow(study_plan& plan, const std::vector<std::string>& only, int cores);

}  // namespace pairsum::harness

#pragma once
#include <pairsum/sum/registry.hpp>

namespace pairsum::harness {

/// The library's registry and ferrari09_hard: with wendland_c2, in double, in every dimension of this build.
const registry& simulate_registry();

}  // namespace pairsum::harness

#pragma once
#include <pairsum/sum/registry.hpp>

namespace pairsum::harness {

/// The library's registry and ferrari09_hard: with wendland_c2, in double, in every dimension of this build.
/// @param spacing of the particles, m; see wall_spacing
const registry& simulate_registry(double spacing);

}  // namespace pairsum::harness

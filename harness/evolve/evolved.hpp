#pragma once
#include <filesystem>
#include <string_view>

#include <pairsum/cases/case.hpp>
#include "harness/evolve/initial_of.hpp"

namespace pairsum::harness {

/// The particles of a case, stepped from rest to `time` s by one recipe whatever is measured on them: ferrari09_hard,
/// wendland_c2 and H = 2 dx in double, predictor_corrector, time_step() with cfl 0.2, without those that leave. Then H
/// is what `c` says. They are made once and kept in cache_folder(), by what they are made from.
particles_of_request evolved(std::string_view case_name, const case_parameters& c, double time);

/// Makes a folder and those above it; there may be one. Throws pairsum::error.
void make_folder(const std::filesystem::path& folder);

/// PAIRSUM_CACHE, or pairsum in XDG_CACHE_HOME or ~/.cache. Throws pairsum::error if none of them is set.
std::filesystem::path cache_folder();

}  // namespace pairsum::harness

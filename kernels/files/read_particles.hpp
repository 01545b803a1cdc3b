#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <pairsum/cases/case.hpp>
#include <pairsum/files/particle_file.hpp>

namespace pairsum::files {

/// Particles of files, complete: what the files do not say was given, derived or assumed, as the facts tell.
struct read_set {
  initial_condition initial;
  std::vector<fact> facts;
  std::string hash;         ///< 16 hexadecimal digits of the bits of particles and domain
  double dx = 0;            ///< m: the median of (m/rho)^(1/dim) of the fluid, or of distances to the nearest neighbour
  std::size_t wrapped = 0;  ///< positions that lay outside of a periodic box
  double time = 0;          ///< s, of the files
};

/// Reads one or several files as one set. A path may end in ":fluid" or ":boundary", which all its particles are then.
/// Fluid comes first, then boundary, otherwise as in the files. 2D data in three columns becomes 2D: a column that is
/// constant is left out, and the others become x and y. Errors: those of the formats, what files of one set disagree
/// on, what is missing and cannot be derived (names the option that says it), values that are not finite, masses and
/// densities that are not positive, more than 2^32 - 1025 particles.
read_set read_particles(const std::vector<std::string>& paths, const hints& told = {});

/// The hash of a set with this content.
std::string hash_of(const initial_condition& c);

}  // namespace pairsum::files

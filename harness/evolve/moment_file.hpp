#pragma once
#include <filesystem>
#include <string>

#include <pairsum/cases/case.hpp>
#include "harness/evolve/simulation.hpp"

namespace pairsum::harness {

/// Writes a moment as an .hdf file that other programs and pairsum itself read (kernels/files/write_hdf.hpp): the old
/// file or the new one is there, never a part.
/// @param settings what made it, for read_moment()
void write_moment(const std::filesystem::path& file, const moment& m, const initial_condition& domain,
                  const std::string& settings);

/// A moment as it was written, bit for bit.
struct saved_moment {
  moment what;
  std::string settings;
};
saved_moment read_moment(const std::filesystem::path& file);

/// 16 hex digits of the particles' bits.
std::string hash_of(const particle_table& p);

/// Can this build write and read them? Else why not, one line.
std::string why_no_moment_files();

}  // namespace pairsum::harness

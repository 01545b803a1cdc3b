#pragma once
#include <filesystem>
#include <string>
#include <vector>

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
  std::string hash;  ///< 16 hex digits of particles and domain
};
saved_moment read_moment(const std::filesystem::path& file);

/// A series of such files for ParaView, as XDMF.
void write_series(const std::filesystem::path& file, const std::vector<std::filesystem::path>& moments);

/// Can this build write and read them? Else why not, one line.
std::string why_no_moment_files();

}  // namespace pairsum::harness

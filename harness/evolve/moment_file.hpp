#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <pairsum/cases/case.hpp>
#include "harness/evolve/initial_of.hpp"
#include "harness/evolve/simulation.hpp"

namespace pairsum::harness {

/// Writes a moment as an .hdf file that other programs and pairsum itself read (kernels/files/write_hdf.hpp): the old
/// file or the new one is there, never a part.
/// @param start the particles that it began with, their domain and what is known of them
/// @param settings what made it, for read_moment()
void write_moment(const std::filesystem::path& file, const moment& m, const particles_of_request& start,
                  const std::string& settings);

/// A moment as it was written, bit for bit.
struct saved_moment {
  moment what;
  std::string settings;
  std::string hash;  ///< 16 hex digits of particles and domain
};
saved_moment read_moment(const std::filesystem::path& file);

/// A series of such files for ParaView, as XDMF.
struct moment_in_series {
  std::filesystem::path file;
  double t = 0;  ///< s
  std::size_t particles = 0;
};
void write_series(const std::filesystem::path& file, const std::vector<moment_in_series>& moments);
/// What such a file says of itself. Throws pairsum::error for another file.
moment_in_series series_entry(const std::filesystem::path& file);

/// Can this build write and read them? Else why not, one line.
std::string why_no_moment_files();

}  // namespace pairsum::harness

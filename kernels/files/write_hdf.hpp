#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <pairsum/cases/case.hpp>
#include <pairsum/files/particle_file.hpp>

namespace pairsum::files {

/// What a snapshot says besides its particles and their domain.
struct snapshot {
  double time = 0;         ///< s
  std::uint64_t step = 0;  ///< that were made
  double dx = 0;           ///< particle spacing, m; 0: left out
  std::vector<fact> facts;
  std::vector<std::uint32_t> ids;  ///< of the rows, ascending; empty: their numbers
  std::uint64_t lost = 0;          ///< particles that have left the domain before, besides rows that are lost
  double next_dt = 0;              ///< s, of the time step that comes
  std::string settings;            ///< what made it, for the program that goes on from here
};

/// Writes particles and their domain as HDF5 with the names of GADGET: all in /PartType0, with a column Kind (0 fluid,
/// 1 boundary), and what GADGET has no name for in attributes of /Header. The group /VTKHDF has hard links to the same
/// data, for VTK 9.1 and ParaView 5.11, which want the ending .hdf. Positions and velocities have three columns, of
/// zeros beyond Dimension. Particles that are lost are left out. read_particles gives the same bits. The file appears
/// under its name when it is whole. Errors: what the system or HDF5 says.
void write_hdf(const std::string& path, const initial_condition& c, const snapshot& about = {});

/// What a file of write_hdf says besides its particles and their domain, which read_particles reads; without facts.
/// Errors: a file that write_hdf has not written.
snapshot read_about(const std::string& path);

/// A file of write_hdf in a series.
struct snapshot_file {
  std::string path;
  double time = 0;
  std::size_t particles = 0;
};

/// Writes a series as XDMF 3, by which ParaView opens it as one: https://www.xdmf.org/index.php/XDMF_Model_and_Format.
/// The paths of its files become relative to it.
void write_xmf(const std::string& path, const std::vector<snapshot_file>& series);

}  // namespace pairsum::files

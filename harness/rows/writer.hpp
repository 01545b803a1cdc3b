#pragma once

#include <filesystem>
#include <string>

#include "harness/rows/reader.hpp"
#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// Appends rows to a file so that whatever happens to the process, the file holds whole rows: each
/// row is one write(2) followed by fsync(2), and a write that the system cut short is undone.
class row_writer {
 public:
  /// Opens `path` for appending and creates the folders above it. Throws pairsum::error with one
  /// line if that is not possible, or if the file exists and is neither empty nor a valid rows
  /// file.
  explicit row_writer(const std::filesystem::path& path);
  /// The same for a file that was read already, with what its rows may name: it is not read again.
  row_writer(std::filesystem::path path, known_names known);
  ~row_writer();
  row_writer(const row_writer&) = delete;
  row_writer& operator=(const row_writer&) = delete;

  /// Writes one row durably. Numbers that are not finite are written as null; a row that the reader
  /// would refuse (also a sample whose environment or backend row is not in the file) throws
  /// pairsum::error unwritten.
  void write(const row& value);

  const std::filesystem::path& path() const { return path_; }
  /// Is there an environment row of this id in the file?
  bool knows(const std::string& environment) const { return known_.environments.contains(environment); }
  /// Is there a backend row of that environment and name in the file?
  bool knows(const std::string& environment, const std::string& backend) const {
    return known_.backends.contains({environment, backend});
  }

  /// Is there a particles row of that hash in the file?
  bool knows_particles(const std::string& hash) const { return known_.particles.contains(hash); }

 private:
  template <class Row>
  void must_be_known(const Row& r) const;

  std::filesystem::path path_;
  int file_ = -1;
  known_names known_;
};

}  // namespace pairsum::harness

#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// Appends rows to a file so that whatever happens to the process, the file holds whole rows: each
/// row is one write(2) followed by fsync(2), and a write that the system cut short is taken back.
class row_writer {
 public:
  /// Opens `path` for appending and creates the folders above it. Throws pairsum::error with one
  /// line if that is not possible, or if the file exists and is neither empty nor a valid rows
  /// file.
  explicit row_writer(std::filesystem::path path);
  ~row_writer();
  row_writer(const row_writer&) = delete;
  row_writer& operator=(const row_writer&) = delete;

  /// Writes one row durably. Numbers that are not finite are written as null; a row that the reader
  /// would refuse (also a sample whose environment row is not in the file) throws pairsum::error
  /// unwritten.
  void write(const row& value);

  const std::filesystem::path& path() const { return path_; }
  /// Is there an environment row of this id in the file?
  bool knows(const std::string& environment) const { return environments_.count(environment) != 0; }

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::set<std::string> environments_;
};

/// Takes a last line away that was cut while it was written, so that rows can be appended. Returns the number of bytes
/// taken away; 0 if there is no file or nothing to mend. Throws like read_rows for any other fault.
std::size_t drop_cut_line(const std::filesystem::path& path);

}  // namespace pairsum::harness

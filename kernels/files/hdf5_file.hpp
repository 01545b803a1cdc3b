#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pairsum/files/hdf5_handle.hpp>

namespace pairsum::files {

/// An HDF5 file to read from, without what it must not do to us: no count is believed before it was compared with what
/// is stored. Paths of objects have no leading slash; the empty path is the root. Errors are pairsum::error with one
/// line that begins with the file's path.
class hdf5_file {
 public:
  explicit hdf5_file(std::string path);

  const std::string& path() const { return path_; }
  /// Does the object, the last of these names, exist?
  bool has(const std::string& object) const;
  /// The names in a group, sorted; empty for what is none.
  std::vector<std::string> names(const std::string& group) const;
  /// The numbers of an attribute, at most 64; none where there is no such attribute, or one of texts.
  std::optional<std::vector<double>> numbers(const std::string& object, const std::string& attribute) const;
  std::optional<std::string> text(const std::string& object, const std::string& attribute) const;

  struct shape {
    std::size_t rows = 0, columns = 1;
  };
  /// The shape of a dataset of numbers, N or N x (1 to 3), with no more rows than the stored bytes can make.
  shape shape_of(const std::string& dataset) const;
  /// Reads one or more columns of a dataset whose shape was asked for: column `which[k]`, all rows, to `to[k]`.
  void read(const std::string& dataset, std::span<const std::size_t> which, std::span<double* const> to) const;

 private:
  [[noreturn]] void fail(const std::string& object, const std::string& why) const;
  hdf5_handle open(const std::string& object) const;

  std::string path_;
  hdf5_handle file_;
};

}  // namespace pairsum::files

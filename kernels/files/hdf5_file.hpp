#pragma once
#include <hdf5.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pairsum::files {

/// Owns what HDF5 numbers.
class hdf5_handle {
 public:
  hdf5_handle() = default;
  hdf5_handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  hdf5_handle(hdf5_handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  hdf5_handle& operator=(hdf5_handle&&) = delete;
  ~hdf5_handle() {
    if (id_ >= 0) close_(id_);
  }
  explicit operator bool() const { return id_ >= 0; }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): for calls of the library

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

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

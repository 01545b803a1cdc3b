#pragma once
#include <cstddef>
#include <filesystem>

namespace pairsum::harness {

/// Keeps other programs that ask for the same lock away from a rows file while it is written. The lock goes with the
/// process, however that ends; no file is made.
class file_lock {
 public:
  /// Throws pairsum::error if the lock is held by another process, or for a pipe with a name. A file that does not
  /// exist yet is not locked: call take() once it does.
  explicit file_lock(std::filesystem::path path);
  ~file_lock();
  file_lock(const file_lock&) = delete;
  file_lock& operator=(const file_lock&) = delete;

  /// Takes the lock if it is not held yet.
  void take();
  /// Throws pairsum::error if the file that was locked is no longer there under its name, or was cut to less than
  /// `least` bytes: rows would go to where nobody finds them.
  void must_be_in_place(std::size_t least) const;

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace pairsum::harness

#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace pairsum::harness {

/// Bytes by key that the processes of a study hand to each other, in a file without a name: whatever ends the study,
/// nothing is left behind. One process uses it at a time. Later bytes of a key replace earlier ones.
class shared_store {
 public:
  /// A new, empty one. Throws pairsum::error if the system has no room for it.
  shared_store();
  /// The one that another process made and left open as this file descriptor; throws pairsum::error if it is none.
  explicit shared_store(int descriptor);
  /// The one that another process has open at this path of /proc; none if there is no store.
  static std::unique_ptr<shared_store> open(const std::string& path);
  ~shared_store();
  shared_store(const shared_store&) = delete;
  shared_store& operator=(const shared_store&) = delete;

  int descriptor() const { return file_; }

  std::optional<std::string> load(const std::string& key) const;
  void save(const std::string& key, const std::string& bytes);

  /// Where the store ends; truncate(end) forgets what was saved since, as is needed after a process that was killed
  /// while it saved.
  std::size_t end() const;
  void truncate(std::size_t end);

 private:
  int file_;
};

}  // namespace pairsum::harness

#pragma once
#include <filesystem>
#include <utility>

#include "harness/rows/writer.hpp"

namespace pairsum::harness {

/// Makes the rows file, so that it can be locked and whatever keeps it from being written is told before anything is
/// measured; takes it away again if it was new, or empty, and no row came. (A study that is killed before its first row
/// leaves an empty file.)
class writable_file {
 public:
  explicit writable_file(std::filesystem::path path)
      : path_(std::move(path)), is_new_(is_empty(path_)), folder_is_new_(is_new_ && !exists(folder())) {
    row_writer make_it(path_, {});  // whoever asks has read what is there
  }
  ~writable_file() {
    std::error_code code;
    if (!is_new_ || std::filesystem::file_size(path_, code) != 0 || code) return;
    std::filesystem::remove(path_, code);
    if (folder_is_new_) std::filesystem::remove(folder(), code);  // only if nothing else is in it
  }
  writable_file(const writable_file&) = delete;
  writable_file& operator=(const writable_file&) = delete;

 private:
  static bool is_empty(const std::filesystem::path& p) {
    std::error_code code;
    return !std::filesystem::exists(p, code) || std::filesystem::file_size(p, code) == 0;
  }
  static bool exists(const std::filesystem::path& p) {
    std::error_code code;
    return std::filesystem::exists(p, code);
  }
  std::filesystem::path folder() const { return path_.has_parent_path() ? path_.parent_path() : "."; }

  std::filesystem::path path_;
  bool is_new_, folder_is_new_;
};

}  // namespace pairsum::harness

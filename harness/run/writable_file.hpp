#pragma once
#include <filesystem>
#include <utility>
#include <vector>

#include "harness/rows/writer.hpp"

namespace pairsum::harness {

/// Takes the folders away that were not there when it was made, if nothing is in them when it ends.
class new_folders {
 public:
  explicit new_folders(std::filesystem::path folder) {
    std::error_code code;
    for (; !folder.empty() && !std::filesystem::exists(folder, code); folder = folder.parent_path())
      folders_.push_back(folder);
  }
  ~new_folders() {
    std::error_code code;
    for (const auto& folder : folders_) std::filesystem::remove(folder, code);
  }
  new_folders(const new_folders&) = delete;
  new_folders& operator=(const new_folders&) = delete;

 private:
  std::vector<std::filesystem::path> folders_;  ///< the deepest first
};

/// Makes the rows file, so that it can be locked and whatever keeps it from being written is told before anything is
/// measured; takes it away again if it was new, or empty, and no row came, with its new folders. (A study that is
/// killed before its first row leaves an empty file.)
class writable_file {
 public:
  explicit writable_file(std::filesystem::path path)
      : path_(std::move(path)), is_new_(is_empty(path_)), folders_(path_.parent_path()) {
    row_writer make_it(path_, {});  // whoever asks has read what is there
  }
  ~writable_file() {
    std::error_code code;
    if (is_new_ && std::filesystem::file_size(path_, code) == 0 && !code) std::filesystem::remove(path_, code);
  }
  writable_file(const writable_file&) = delete;
  writable_file& operator=(const writable_file&) = delete;

 private:
  static bool is_empty(const std::filesystem::path& p) {
    std::error_code code;
    return !std::filesystem::exists(p, code) || std::filesystem::file_size(p, code) == 0;
  }

  std::filesystem::path path_;
  bool is_new_;
  new_folders folders_;
};

}  // namespace pairsum::harness

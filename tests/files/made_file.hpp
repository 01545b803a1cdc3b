#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/files/formats.hpp>

namespace pairsum::files {

/// A file that lives as long as the object.
struct made_file {
  std::string path;

  made_file(const std::string& name, const std::string& bytes)
      : path(testing::TempDir() + std::to_string(getpid()) + '_' + name) {
    std::ofstream(path, std::ios::binary) << bytes;
  }
  made_file(const made_file&) = delete;
  ~made_file() { unlink(path.c_str()); }
};

inline file_content read_bytes(const std::string& name, const std::string& bytes, const hints& told = {}) {
  return read_file(made_file(name, bytes).path, told);
}

/// What the reader says of bytes it must refuse, without the path, or "read" if it does not.
inline std::string refusal(const std::string& name, const std::string& bytes, const hints& told = {}) {
  const made_file file(name, bytes);
  try {
    read_file(file.path, told);
  } catch (const error& e) {
    const std::string what = e.what();
    return what.starts_with(file.path) ? what.substr(file.path.size()) : what;
  }
  return "read";
}

using numbers = std::vector<double>;

}  // namespace pairsum::files

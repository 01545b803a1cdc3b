#pragma once
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include <pairsum/core/error.hpp>

namespace pairsum::files {

/// Calls write(temporary), and gives what that wrote the name `path`; nothing is left if it throws.
template <class F>
void write_whole(const std::string& path, F&& write) {
  const std::string temporary = path + "." + std::to_string(getpid()) + ".tmp";
  try {
    write(temporary);
    if (std::rename(temporary.c_str(), path.c_str()) != 0)
      throw error("cannot write " + path + ": " + std::strerror(errno));
  } catch (...) {
    unlink(temporary.c_str());
    throw;
  }
}

}  // namespace pairsum::files

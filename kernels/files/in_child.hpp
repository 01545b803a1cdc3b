#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include <pairsum/files/particle_file.hpp>

namespace pairsum::files {

/// What `read` returns, called in a child process that hands it over through a pipe: for libraries that may crash or
/// hang on a damaged file. A pairsum::error of `read` is thrown here, too. Errors: the child dies, or takes more than
/// `limit_s` seconds; `path` is named in the line.
file_content in_child(const std::string& path, unsigned limit_s, const std::function<file_content()>& read);

/// How many seconds a file of that size may take: many times what a slow disk needs.
inline unsigned seconds_for(std::uint64_t bytes) { return 20 + static_cast<unsigned>(bytes / 4'000'000); }

}  // namespace pairsum::files

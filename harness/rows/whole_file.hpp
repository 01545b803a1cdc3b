#pragma once

#include <filesystem>
#include <string>

namespace pairsum::harness {

/// Writes a text to a temporary file beside `path`, then renames it: there is the old file or the new one, never a
/// part. Creates the folders above. Throws pairsum::error with one line if it cannot.
void write_whole_file(const std::string& text, const std::filesystem::path& path);

}  // namespace pairsum::harness

#pragma once

#include <filesystem>
#include <string>

namespace pairsum::harness {

/// Writes a text to a file without a name beside `path`, then puts it there: there is the old file or the new one,
/// never a part, and no other, even if the program is killed while it writes. Creates the folders above. Throws
/// pairsum::error with one line if it cannot.
void write_whole_file(const std::string& text, const std::filesystem::path& path);

}  // namespace pairsum::harness

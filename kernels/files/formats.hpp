#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/files/particle_file.hpp>

namespace pairsum::files {

/// A format of particle files. `recognises` sees the first 4096 bytes of a file, or all of a shorter one, and its path.
/// `read` throws pairsum::error with one line that begins with the path.
struct file_format {
  std::string_view name, description;
  bool (*recognises)(std::span<const std::byte> head, std::string_view path);
  file_content (*read)(const std::string& path, const hints&);
};

/// All formats, in the order of formats.def.
const std::vector<file_format>& file_formats();

/// What the first format that recognises the file reads there. Errors: nothing there, no file, an unknown format, and
/// those of the format.
file_content read_file(const std::string& path, const hints& told = {});

/// Does the path end so, in upper or lower case? For `recognises`.
bool ends_in(std::string_view path, std::string_view ending);

}  // namespace pairsum::files

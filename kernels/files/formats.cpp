// The formats of formats.def, and who reads a file.
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/files/formats.hpp>
#include <pairsum/files/words.hpp>

#define FORMAT(word) file_format word();
namespace pairsum::files::formats_of {
#include <pairsum/files/formats.def>
}
#undef FORMAT

namespace pairsum::files {
namespace {

/// Refuses what is no file before it is opened: opening a pipe would wait for a writer.
void check_is_file(const std::string& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0) throw error("cannot read " + path + ": " + std::strerror(errno));
  if (S_ISDIR(about.st_mode)) throw error("cannot read " + path + ": it is a folder, should be a file of particles");
  if (!S_ISREG(about.st_mode)) throw error("cannot read " + path + ": it is no regular file");
  if (about.st_size == 0) throw error(path + " is empty, should hold particles");
}

/// For formats that other programs turn into ones that pairsum reads.
constexpr std::array<std::string_view, 12> convertible{".vtu", ".vtp",  ".vtk",       ".vti", ".gro",  ".xyz",
                                                       ".gsd", ".dump", ".lammpstrj", ".npz", ".h5md", ".pvd"};

}  // namespace

const std::vector<file_format>& file_formats() {
#define FORMAT(word) formats_of::word(),
  static const std::vector<file_format> all{
#include <pairsum/files/formats.def>
  };
#undef FORMAT
  return all;
}

bool ends_in(std::string_view path, std::string_view ending) {
  return path.size() >= ending.size() && same_word(path.substr(path.size() - ending.size()), ending);
}

file_content read_file(const std::string& path, const hints& told) {
  check_is_file(path);
  std::array<char, 4096> head{};
  std::ifstream file(path, std::ios::binary);
  if (!file) throw error("cannot read " + path + ": " + std::strerror(errno));
  file.read(head.data(), head.size());
  const auto bytes = std::as_bytes(std::span(head.data(), static_cast<std::size_t>(file.gcount())));
  file.close();
  std::vector<std::string> names;
  for (const file_format& f : file_formats()) {
    if (f.recognises(bytes, path)) return f.read(path, told);
    names.emplace_back(f.name);
  }
  const bool other = std::ranges::any_of(convertible, [&](std::string_view ending) { return ends_in(path, ending); });
  throw error(path + " is of no format that pairsum reads: " + join(names) +
              (other ? "; `pairsum convert " + path + " particles.hdf` makes one of it" : ""));
}

}  // namespace pairsum::files

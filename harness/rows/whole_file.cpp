#include "harness/rows/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

void write_whole(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw error(std::strerror(errno));
    done += static_cast<std::size_t>(count);
  }
  if (::fsync(file) != 0) throw error(std::strerror(errno));
}

/// A file in the folder that has no name yet; -1 where the file system has no such files.
int without_a_name(const std::filesystem::path& folder) {
  return ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0644);
}

/// Gives it one. (AT_EMPTY_PATH would take a right that users lack.)
void name(int file, const std::filesystem::path& path) {
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  ::unlink(path.c_str());  // of a process with the same number that was killed
  if (::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) != 0)
    throw error(std::strerror(errno));
}

}  // namespace

void write_whole_file(const std::string& text, const std::filesystem::path& path) {
  const std::filesystem::path temporary = path.string() + "." + std::to_string(::getpid()) + ".tmp";
  int file = -1;
  bool named = false;
  try {
    std::error_code code;
    if (!path.parent_path().empty()) std::filesystem::create_directories(path.parent_path(), code);
    if (code) throw error("folder " + path.parent_path().string() + ": " + code.message());
    file = without_a_name(path.parent_path());
    named = file < 0;
    if (named) file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0) throw error(std::strerror(errno));
    write_whole(file, text);
    if (!named) name(file, temporary);
    named = true;
    if (::rename(temporary.c_str(), path.c_str()) != 0) throw error(std::strerror(errno));
    ::close(file);
  } catch (const error& e) {
    if (file >= 0) ::close(file);
    if (named) ::unlink(temporary.c_str());
    throw error("cannot write " + path.string() + ": " + e.what());
  }
}

}  // namespace pairsum::harness

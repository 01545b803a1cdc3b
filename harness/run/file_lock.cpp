#include "harness/run/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {

file_lock::file_lock(std::filesystem::path path) : path_(std::move(path)) { take(); }

file_lock::~file_lock() {
  if (file_ >= 0) ::close(file_);
}

void file_lock::take() {
  if (file_ >= 0) return;
  std::error_code code;
  if (std::filesystem::is_fifo(path_, code))  // opening it would wait for another program
    throw error(path_.string() + ": is no regular file, should be a rows file");
  file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(file_);
  file_ = -1;
  throw error(path_.string() + " is being written by another pairsum run; wait for it, or name another file");
}

void file_lock::must_be_in_place(std::size_t least) const {
  if (file_ < 0) return;
  struct stat locked {
  }, named{};
  if (::fstat(file_, &locked) != 0 || ::stat(path_.c_str(), &named) != 0 || locked.st_dev != named.st_dev ||
      locked.st_ino != named.st_ino)
    throw error(path_.string() +
                " was deleted, moved or replaced while rows were written to it; start the study again");
  if (static_cast<std::size_t>(named.st_size) < least)
    throw error(path_.string() + " was cut while rows were written to it; start the study again");
}

}  // namespace pairsum::harness

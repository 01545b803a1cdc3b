#include "harness/run/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {

file_lock::file_lock(std::filesystem::path path) : path_(std::move(path)) { take(); }

file_lock::~file_lock() {
  if (file_ >= 0) ::close(file_);
}

void file_lock::take() {
  if (file_ >= 0) return;
  file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(file_);
  file_ = -1;
  throw error(path_.string() + " is being written by another pairsum run; wait for it, or name another file");
}

}  // namespace pairsum::harness

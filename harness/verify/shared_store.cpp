#include "harness/verify/shared_store.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

constexpr const char* called = "pairsum-study";

/// Before the key and the bytes of a record.
struct record_head {
  std::uint64_t key_size, size;
};

[[noreturn]] void fail(const char* what) {
  throw error(std::string("the store that the processes of a study share ") + what + ": " + std::strerror(errno));
}

bool read_at(int file, void* to, std::size_t size, off_t at) {
  char* const bytes = static_cast<char*>(to);
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = ::pread(file, bytes + done, size - done, at + static_cast<off_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

void append(int file, const void* from, std::size_t size) {
  const char* const bytes = static_cast<const char*>(from);
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = ::write(file, bytes + done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("cannot be written");
    done += static_cast<std::size_t>(n);
  }
}

}  // namespace

shared_store::shared_store() : file_(::memfd_create(called, MFD_CLOEXEC)) {
  if (file_ < 0) fail("cannot be made");
}

shared_store::shared_store(int descriptor) : file_(::dup(descriptor)) {
  if (file_ >= 0 && ::lseek(file_, 0, SEEK_END) >= 0) return;
  const int why = errno;
  if (file_ >= 0) ::close(file_);
  errno = why;
  fail("cannot be used");
}

std::unique_ptr<shared_store> shared_store::open(const std::string& path) {
  std::error_code code;
  if (std::filesystem::read_symlink(path, code).string().find(called) == std::string::npos) return nullptr;
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return nullptr;
  auto store = std::make_unique<shared_store>(file);
  ::close(file);
  return store;
}

shared_store::~shared_store() {
  if (file_ >= 0) ::close(file_);
}

std::optional<std::string> shared_store::load(const std::string& key) const {
  std::optional<std::string> found;
  off_t at = 0, found_at = -1;
  std::size_t found_size = 0;
  for (record_head head; read_at(file_, &head, sizeof head, at);) {
    std::string name(head.key_size, '\0');
    at += static_cast<off_t>(sizeof head);
    if (!read_at(file_, name.data(), name.size(), at)) break;
    at += static_cast<off_t>(name.size());
    if (name == key) {
      found_at = at;
      found_size = head.size;
    }
    at += static_cast<off_t>(head.size);
  }
  if (found_at < 0) return found;
  found.emplace(found_size, '\0');
  if (!read_at(file_, found->data(), found_size, found_at)) return std::nullopt;  // cut by the end of its writer
  return found;
}

void shared_store::save(const std::string& key, const std::string& bytes) {
  const off_t end = ::lseek(file_, 0, SEEK_END);
  if (end < 0) fail("cannot be written");
  const record_head head{key.size(), bytes.size()};
  append(file_, &head, sizeof head);
  append(file_, key.data(), key.size());
  append(file_, bytes.data(), bytes.size());
}

std::size_t shared_store::end() const { return static_cast<std::size_t>(::lseek(file_, 0, SEEK_END)); }

void shared_store::truncate(std::size_t end) {
  if (::ftruncate(file_, static_cast<off_t>(end)) != 0) fail("cannot be mended");
}

}  // namespace pairsum::harness

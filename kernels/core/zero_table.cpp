#include "core/zero_table.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "core/error.hpp"

namespace pairsum {

zero_table::zero_table(std::size_t n, const char* what) : n_(n) {
  const std::size_t bytes = n * sizeof(std::uint32_t);
  const std::size_t memory = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                             static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const auto refuse = [&](const std::string& have) {
    throw error(std::string(what) + " needs " + std::to_string(bytes >> 20) + " MiB of memory, but " +
                have + "; a smaller M needs less");
  };
  if (n > memory / sizeof(std::uint32_t)) refuse("this machine has " + std::to_string(memory >> 20) + " MiB");
  void* const p = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (p == MAP_FAILED) refuse("the system does not grant it");
  data_ = static_cast<std::uint32_t*>(p);
}

zero_table::~zero_table() {
  if (data_) munmap(data_, n_ * sizeof(std::uint32_t));
}

}  // namespace pairsum

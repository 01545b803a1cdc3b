#include <pairsum/core/zero_table.hpp>

#include <sys/mman.h>

#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/core/memory.hpp>

namespace pairsum {

zero_table::zero_table(std::size_t n, const char* what, const char* advice) : n_(n) {
  check_memory(static_cast<double>(n) * sizeof(std::uint32_t), what, advice);
  const std::size_t bytes = n * sizeof(std::uint32_t);
  void* const p = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (p == MAP_FAILED)
    throw error(std::string(what) + " needs " + std::to_string(bytes >> 20) +
                " MiB, which the system does not grant; " + advice);
  data_ = static_cast<std::uint32_t*>(p);
}

zero_table::~zero_table() {
  if (data_) munmap(data_, n_ * sizeof(std::uint32_t));
}

}  // namespace pairsum

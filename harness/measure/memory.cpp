#include "harness/measure/memory.hpp"

#include <malloc.h>

#include <fstream>
#include <limits>
#include <string>

namespace pairsum::harness {

void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

std::optional<std::uint64_t> heap_bytes() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  const struct mallinfo2 m = mallinfo2();
  if (m.uordblks + m.hblkhd > 0) return m.uordblks + m.hblkhd;  // 0 of an allocator in glibc's place
#endif
  return std::nullopt;
}

void reset_peak_rss() {
  std::ofstream refs("/proc/self/clear_refs");
  refs << "5\n";
}

std::optional<std::uint64_t> peak_rss_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      std::uint64_t kib = 0;
      if (status >> kib) return kib * 1024;
    }
  return std::nullopt;
}

}  // namespace pairsum::harness

#pragma once
#include <sys/mman.h>

#include <cstdint>
#include <vector>

namespace pairsum::files {

/// Resizes a column, on large pages if it is large: touching a million of small ones takes longer than reading them.
template <class T>
void resize_column(std::vector<T>& a, std::size_t n) {
  constexpr std::uintptr_t large_page = 1 << 21;
  if (a.empty() && n * sizeof(T) > 2 * large_page) {
    a.reserve(n);
    const auto begin = reinterpret_cast<std::uintptr_t>(a.data()),
               first = (begin + large_page - 1) / large_page * large_page;
    madvise(reinterpret_cast<void*>(first), begin + n * sizeof(T) - first, MADV_HUGEPAGE);  // a wish
  }
  a.resize(n);
}

}  // namespace pairsum::files

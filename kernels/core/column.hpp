#pragma once
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace pairsum {

/// Allocates on 64-byte boundaries and leaves trivial elements uninitialised, so that memory is first touched by the
/// thread that fills it.
template <class T>
struct column_allocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  column_allocator() = default;
  template <class U>
  column_allocator(const column_allocator<U>&) {}

  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }

  template <class U>
  void construct(U* p) {
    if constexpr (!std::is_trivially_default_constructible_v<U>) ::new (static_cast<void*>(p)) U();
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
  template <class U>
  bool operator==(const column_allocator<U>&) const {
    return true;
  }
};

/// One quantity of all particles, contiguous and aligned.
template <class T>
using column = std::vector<T, column_allocator<T>>;

}  // namespace pairsum

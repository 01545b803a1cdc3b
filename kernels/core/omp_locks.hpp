#pragma once
#include <omp.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace pairsum {

/// OpenMP's locks, numbered. They are the ones that race detectors know of.
class omp_locks {
 public:
  omp_locks() = default;
  omp_locks(const omp_locks&) = delete;
  omp_locks& operator=(const omp_locks&) = delete;
  ~omp_locks() { destroy(); }

  /// At least `n`; none may be held.
  void resize(std::size_t n) {
    if (n <= size_) return;
    auto more = std::make_unique<omp_lock_t[]>(n);
    destroy();
    lock_ = std::move(more);
    for (; size_ < n; ++size_) omp_init_lock(&lock_[size_]);
  }

  /// Holds up to two locks, taken in the order given; -1: none.
  class guard {
   public:
    guard(omp_locks& locks, std::int32_t first, std::int32_t second)
        : first_(locks.take(first)), second_(locks.take(second)) {}
    guard(const guard&) = delete;
    guard& operator=(const guard&) = delete;
    ~guard() {
      if (second_ != nullptr) omp_unset_lock(second_);
      if (first_ != nullptr) omp_unset_lock(first_);
    }

   private:
    omp_lock_t *first_, *second_;
  };

 private:
  omp_lock_t* take(std::int32_t k) {
    if (k < 0) return nullptr;
    omp_set_lock(&lock_[static_cast<std::size_t>(k)]);
    return &lock_[static_cast<std::size_t>(k)];
  }
  void destroy() {
    for (; size_ > 0; --size_) omp_destroy_lock(&lock_[size_ - 1]);
  }

  std::unique_ptr<omp_lock_t[]> lock_;
  std::size_t size_ = 0;
};

}  // namespace pairsum

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

  /// Holds up to two locks, taken in the order given; -1: none. For one that another thread holds it calls wait(f),
  /// which calls f(), which returns when the lock is free.
  class guard {
   public:
    template <class Wait>
    guard(omp_locks& locks, std::int32_t first, std::int32_t second, Wait&& wait)
        : first_(locks.take(first, wait)), second_(locks.take(second, wait)) {}
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
  template <class Wait>
  omp_lock_t* take(std::int32_t k, Wait&& wait) {
    if (k < 0) return nullptr;
    omp_lock_t* const lock = &lock_[static_cast<std::size_t>(k)];
    if (omp_test_lock(lock) == 0) wait([&] { omp_set_lock(lock); });
    return lock;
  }
  void destroy() {
    for (; size_ > 0; --size_) omp_destroy_lock(&lock_[size_ - 1]);
  }

  std::unique_ptr<omp_lock_t[]> lock_;
  std::size_t size_ = 0;
};

}  // namespace pairsum

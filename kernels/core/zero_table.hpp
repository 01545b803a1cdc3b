#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>

namespace pairsum {

/// A large array of 32-bit zeros of which only the pages that are written take memory. Throws pairsum::error, before
/// anything is allocated, if the array is larger than the machine's memory.
class zero_table {
 public:
  zero_table() = default;
  /// `what` names the array in the error, `advice` what would take less.
  zero_table(std::size_t n, const char* what, const char* advice = "a smaller M takes less");
  ~zero_table();
  zero_table(zero_table&& o) noexcept : data_(std::exchange(o.data_, nullptr)), n_(o.n_) {}
  zero_table& operator=(zero_table&& o) noexcept {
    std::swap(data_, o.data_);
    std::swap(n_, o.n_);
    return *this;
  }

  std::uint32_t* data() const { return data_; }
  std::size_t size() const { return n_; }

 private:
  std::uint32_t* data_ = nullptr;
  std::size_t n_ = 0;
};

}  // namespace pairsum

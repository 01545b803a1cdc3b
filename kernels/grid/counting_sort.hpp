#pragma once
#include <cstdint>
#include <span>

#include <pairsum/core/column.hpp>
#include <pairsum/core/team.hpp>

namespace pairsum {

/// Stable counting sort of keys, digit by digit (least significant first) so that the counters stay in cache however
/// many cells there are. Parallel over the team; the result is the same for every team: the order of equal keys is
/// kept.
class counting_sort {
 public:
  /// Sorts indices [0, keys.size()) by keys < 2^bits. Afterwards `order()[k]` is the index of the k-th smallest key.
  void sort(std::span<const std::uint32_t> keys, int bits, const team& t);
  std::span<const std::uint32_t> order() const { return order_; }

  static constexpr int digit_bits = 11;

 private:
  struct item {
    std::uint32_t key, index;
  };
  void pass(const item* from, item* to, std::size_t n, int shift, int bits, const team& t);

  column<item> a_, b_;
  column<std::uint32_t> counts_, order_;
};

}  // namespace pairsum

#pragma once
#include <cstdint>
#include <cstring>

namespace pairsum {

/// A 64-bit hash of a sequence of numbers' bits: FNV-1a over 64-bit words (Fowler, Noll, Vo), with a fold against its
/// weak low bits.
class word_hash {
 public:
  template <class T>
  void add(const T& a) {
    std::uint64_t word = 0;
    static_assert(sizeof a <= sizeof word);
    std::memcpy(&word, &a, sizeof a);
    hash_ = (hash_ ^ word) * 0x100000001b3u;
    hash_ ^= hash_ >> 29;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace pairsum

#pragma once
#include <cstdint>

namespace pairsum {

/// Counter-based random numbers: the value depends on (seed, stream, counter) alone, so it is the same on every
/// platform, for every thread count and in any order. Mixing function: the 64-bit finaliser "variant 13" of D.
/// Stafford, as used by splitmix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
class counter_random {
 public:
  explicit constexpr counter_random(std::uint64_t seed, std::uint64_t stream = 0)
      : key_(mix(mix(seed + golden) ^ (stream * golden))) {}

  /// 64 uniform bits.
  constexpr std::uint64_t bits(std::uint64_t counter) const { return mix(key_ + (counter + 1) * golden); }
  /// Uniform in [0, 1), a multiple of 2^-53.
  constexpr double uniform(std::uint64_t counter) const { return static_cast<double>(bits(counter) >> 11) * 0x1.0p-53; }
  /// Uniform in [low, high).
  constexpr double uniform(std::uint64_t counter, double low, double high) const {
    return low + (high - low) * uniform(counter);
  }

 private:
  static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t key_;
};

}  // namespace pairsum

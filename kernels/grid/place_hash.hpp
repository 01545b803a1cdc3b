#pragma once
#include <cstddef>
#include <cstdint>

#include <pairsum/core/vec.hpp>

namespace pairsum {

/// Hashes cell coordinates, for std::unordered_map.
template <int D>
struct place_hash {
  std::size_t operator()(const ivec<D>& v) const {
    std::uint64_t h = 0;
    for (const std::int64_t a : v) h = (h ^ static_cast<std::uint64_t>(a)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(h ^ h >> 32);
  }
};

}  // namespace pairsum

#pragma once
#include <cstddef>
#include <cstdint>

namespace pairsum {

/// Where rates lie: a column for each scalar, or, for vector units, begin[0] with `stride` bytes from one particle to
/// the next.
struct rate_view {
  void* const* begin = nullptr;
  std::size_t stride = 0;
};

/// How a sum adds to rates.
enum class update : unsigned {
  plain,
  atomic,  ///< every addition is atomic
  split,   ///< to a buffer where a block of 64 particles has one, else to the rates
};
inline constexpr unsigned updates = 3;

/// What a unit of work adds to.
struct target {
  rate_view u;
  update how = update::plain;
  int thread = 0;                       ///< of the team
  rate_view buffer{};                   ///< split: blocks of split_block particles, by slot
  const std::uint32_t* slot = nullptr;  ///< split: the slot of each block, or `unsplit`
};
inline constexpr std::size_t split_block = 64;
inline constexpr std::uint32_t unsplit = ~std::uint32_t{0};

}  // namespace pairsum

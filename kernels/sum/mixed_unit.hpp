#pragma once
#include <cmath>
#include <cstdint>

namespace pairsum {

/// A mixed interaction's positions are counted in a power of two of metres, of which so many or more make a cutoff.
inline constexpr double mixed_places_per_reach = 1 << 28;
inline double mixed_unit(double reach) { return std::exp2(std::floor(std::log2(reach / mixed_places_per_reach))); }
/// Along a periodic axis: as fine, and such that the edge is a multiple of 2^32, so that differences modulo
/// 2^32 are those through the faces too. Edges of one turn are at least 3 cutoffs, so that a cutoff fits in half a
/// turn.
inline double mixed_unit(double reach, double edge) {
  constexpr double turn = 4294967296, spare = 1.01;
  return edge / ((std::floor(spare * edge / reach * (mixed_places_per_reach / turn)) + 1) * turn);
}

/// x, rounded to a whole number, modulo 2^32, whatever its size: no rounding but the last.
inline std::int32_t modulo_2_32(double x) {
  constexpr double turn = 4294967296;
  const double rest = std::floor(x - std::floor(x * (1 / turn) + 0.5) * turn + 0.5);  // in [-2^31, 2^31]
  // Where doubles are coarser than 2^32 places, any number will do that is the same for the same x.
  return static_cast<std::int32_t>(
      static_cast<std::uint32_t>(static_cast<std::int64_t>(std::abs(rest) <= turn ? rest : 0)));
}

}  // namespace pairsum

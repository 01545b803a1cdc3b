#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/vec.hpp"

namespace pairsum {

/// Smallest safe width of a cell (m). Computed coordinates t = (x-A)*(1/w) carry a relative error of at most 3u
/// (subtraction, reciprocal, product; u = half the machine epsilon), so two of them differ from the exact difference by
/// at most 6u t_max; a computed r < H means an exact distance below H (1 + 4u) per component. Hence w >= H (1 + 4u + 6u
/// t_max), doubled for safety. t_max is Omega's largest edge in units of H, however large: cells grow with it, so that
/// no coordinate ever exceeds 1/(12u) (1.4e6 in float, 7.5e14 in double) and every one is resolved.
template <int D, class R>
R safe_width(const box<D, R>& omega, R H) {
  const R u = std::numeric_limits<R>::epsilon() / 2;
  R t_max = 0;
  for (int d = 0; d < D; ++d) t_max = std::max(t_max, (omega.high[d] - omega.low[d]) / H);
  return H * (1 + 8 * u + 12 * u * t_max);
}

/// Are numbers as large as Omega's edges less than H apart in R? If not, cells of about H mean nothing there.
template <int D, class R>
bool resolves(const box<D, R>& omega, R H) {
  bool fine = true;
  for (int d = 0; d < D; ++d)
    fine = fine && (omega.high[d] - omega.low[d]) * std::numeric_limits<R>::epsilon() < H;  // not if it overflows
  return fine;
}

/// Turns positions into cell coordinates floor((x-A)/w), w being the safe width. Every grid numbers cells with this
/// one expression, so that they put particles into the same cells.
template <int D, class R>
struct cell_scale {
  vec<D, R> low;  ///< A, m
  R w, inv_w;
  bool narrow;  ///< do the coordinates of all of Omega fit 32 bits? Those convert several at a time.

  cell_scale(const box<D, R>& omega, R H) : low(omega.low), w(safe_width(omega, H)), inv_w(1 / w), narrow(true) {
    for (int d = 0; d < D; ++d) narrow = narrow && (omega.high[d] - omega.low[d]) * inv_w < limit<std::int32_t>;
  }

  /// Coordinate of x along axis d; 0 for x left of Omega, beyond what Int holds, or NaN. Int is 32 bits wide if
  /// `narrow`, else 64.
  template <class Int>
  Int cell(int d, R x) const {
    const R t = (x - low[d]) * inv_w;
    return static_cast<Int>(t >= 0 && t < limit<Int> ? t : R(0));
  }

  /// Calls f(Int{}) with the type that the coordinates need.
  template <class F>
  auto with_integer(F&& f) const {
    return narrow ? f(std::int32_t{}) : f(std::int64_t{});
  }

 private:
  template <class Int>
  static constexpr R limit = std::is_same_v<Int, std::int32_t> ? R(0x1p30) : R(0x1p62);
};

}  // namespace pairsum

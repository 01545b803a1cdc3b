#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <pairsum/core/vec.hpp>

namespace pairsum {

/// Smallest safe width of a cell (m). Computed coordinates t = (x-A)*(1/w) carry a relative error of at most 3u
/// (subtraction, reciprocal, product; u = half the machine epsilon), so two of them differ from the exact difference by
/// at most 6u t_max; a computed r < H means an exact distance below H (1 + 4u) per component. Hence w >= H (1 + 4u + 6u
/// t_max), doubled for safety. t_max is Omega's largest edge in units of H, however large: cells grow with it, so that
/// no coordinate ever exceeds 1/(12u) (1.4e6 in float, 7.5e14 in double) and every one is resolved. Along a periodic
/// axis a difference as large as the edge is rounded before the edge is taken off, and coordinates begin again where 3u
/// t_max may be missing: 10u t_max in all, for which there is twice as much again.
template <int D, class R>
R safe_width(const box<D, R>& omega, R H) {
  const R u = std::numeric_limits<R>::epsilon() / 2;
  R t_max = 0;
  for (int d = 0; d < D; ++d) t_max = std::max(t_max, (omega.high[d] - omega.low[d]) / H);
  return H * (1 + 8 * u + (omega.periodic.any() ? 24 : 12) * u * t_max);
}

/// The number of cells along each periodic axis: as many as are no narrower than is safe, 4 or more, and a multiple of
/// `multiple` (an even number). For a multiple of 2 it is 3 where only these fit, and 0 where nothing does, and along
/// the other axes.
///
/// H alone is safe where coordinates are exact: H a power of two and the low face at 0. Then x/H has no rounding, and
/// differences of H or more, also less an edge of whole H, are never rounded to less.
template <int D, class R>
ivec<D> torus_cells(const box<D, R>& omega, R H, std::int64_t multiple) {
  int exponent = 0;
  const bool exact_inverse = std::frexp(H, &exponent) == R(0.5);
  const R safe = safe_width(omega, H);
  ivec<D> n{};
  for (int d = 0; d < D; ++d) {
    if (!omega.periodic[d]) continue;
    const R edge = omega.edge(d), reaches = edge / H;
    const auto whole = static_cast<std::int64_t>(std::min(reaches, R(0x1p62)));
    const bool exact = exact_inverse && omega.low[d] == 0 && reaches == static_cast<R>(whole);
    if (exact && whole % multiple == 0 && whole <= std::int64_t{1} << (std::numeric_limits<R>::digits - 1)) {
      n[d] = whole;
    } else {
      n[d] = static_cast<std::int64_t>(std::min(edge / safe, R(0x1p62))) / multiple * multiple;
      if (n[d] > 0 && edge / static_cast<R>(n[d]) < safe) n[d] -= multiple;
    }
    if (n[d] < 4) n[d] = multiple == 2 && ((exact && whole == 3) || edge / 3 >= safe) ? 3 : 0;
  }
  return n;
}

/// Are numbers as large as Omega's edges less than H apart in R? If not, cells of about H mean nothing there.
template <int D, class R>
bool resolves(const box<D, R>& omega, R H) {
  bool fine = true;
  for (int d = 0; d < D; ++d)
    fine = fine && (omega.high[d] - omega.low[d]) * std::numeric_limits<R>::epsilon() < H;  // not if it overflows
  return fine;
}

/// Turns positions into cell coordinates floor((x-A)/w), w being the safe width, or what makes whole cells of a
/// periodic axis. Every grid numbers cells with this one expression, so that they put particles into the same cells.
template <int D, class R>
struct cell_scale {
  vec<D, R> low;     ///< A, m
  ivec<D> period{};  ///< cells of a periodic axis; else 0
  vec<D, R> w, inv_w;
  vec<D, R> limit;     ///< coordinates are below it
  bool narrow = true;  ///< do the coordinates of all of Omega fit 32 bits? Those convert several at a time.

  cell_scale(const box<D, R>& omega, R H, const ivec<D>& cells = {}) : low(omega.low), period(cells) {
    const R safe = safe_width(omega, H);
    for (int d = 0; d < D; ++d) {
      w[d] = period[d] > 0 ? omega.edge(d) / static_cast<R>(period[d]) : safe;
      inv_w[d] = 1 / w[d];
      narrow = narrow && omega.edge(d) * inv_w[d] < R(0x1p30);
    }
    for (int d = 0; d < D; ++d) limit[d] = period[d] > 0 ? static_cast<R>(period[d]) : narrow ? R(0x1p30) : R(0x1p62);
  }

  /// Coordinate of x along axis d; 0 for x left of Omega, beyond what Int holds, where rounding takes it to the end of
  /// a period, or NaN. Int is 32 bits wide if `narrow`, else 64.
  template <class Int>
  Int cell(int d, R x) const {
    const R t = (x - low[d]) * inv_w[d];
    return static_cast<Int>(t >= 0 && t < limit[d] ? t : R(0));
  }

  /// Calls f(Int{}) with the type that the coordinates need.
  template <class F>
  auto with_integer(F&& f) const {
    return narrow ? f(std::int32_t{}) : f(std::int64_t{});
  }
};

}  // namespace pairsum

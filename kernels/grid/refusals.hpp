#pragma once
#include <algorithm>
#include <limits>
#include <string>
#include <string_view>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/precision.hpp>
#include <pairsum/grid/cell_scale.hpp>

namespace pairsum {

/// Throws pairsum::error if R does not resolve H in Omega, see resolves(); `grid` is the grid's name.
template <int D, class R>
void check_resolution(const box<D, R>& omega, R H, std::string_view grid) {
  if (resolves(omega, H)) return;
  double edge = 0;
  for (int d = 0; d < D; ++d)
    edge = std::max(edge, static_cast<double>(omega.high[d]) - static_cast<double>(omega.low[d]));
  throw error(std::string(grid) + ": numbers as large as Omega's edge of " + number_text(edge) + " m are " +
              number_text(edge * static_cast<double>(std::numeric_limits<R>::epsilon())) + " m apart in " +
              std::string(precision_name<R>()) + ", which does not resolve the support radius H of " +
              number_text(static_cast<double>(H)) + " m; make Omega smaller" +
              (std::is_same_v<R, float> ? " or take double" : ""));
}

/// "12.5 x 8 x 8": Omega's edges in units of H.
template <int D, class R>
std::string edges_text(const box<D, R>& omega, R H) {
  std::string text;
  for (int d = 0; d < D; ++d)
    text += (d > 0 ? " x " : "") + number_text(static_cast<double>(omega.edge(d)) / static_cast<double>(H));
  return text;
}

/// Do cells of support radius H go round every periodic axis? See torus_cells().
template <int D, class R>
bool goes_round(const box<D, R>& omega, R H, std::int64_t multiple) {
  const ivec<D> n = torus_cells(omega, H, multiple);
  bool all = true;
  for (int d = 0; d < D; ++d) all = all && (n[d] > 0 || !omega.periodic[d]);
  return all;
}

/// Throws pairsum::error if fewer than 3 cells fit along a periodic axis; else returns how many, 0 along the others.
template <int D, class R>
ivec<D> check_periodic(const box<D, R>& omega, R H) {
  if (goes_round(omega, H, 2)) return torus_cells(omega, H, 2);
  R third = H, fits = H;
  for (int d = 0; d < D; ++d)
    if (omega.periodic[d]) third = std::min(third, omega.edge(d) / 3);
  for (R less = std::numeric_limits<R>::epsilon(); !goes_round(omega, fits, 2); less *= 2) fits = third * (1 - less);
  throw error("the periodic box of " + edges_text(omega, H) +
              " support radii is too small: 3 cells must fit along each " +
              "periodic axis, each as wide as the support radius and what rounding takes; one of " +
              number_text(static_cast<double>(fits)) + " m fits");
}

}  // namespace pairsum

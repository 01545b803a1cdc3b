#pragma once
#include <limits>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/precision.hpp"
#include "grid/cell_scale.hpp"

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

}  // namespace pairsum

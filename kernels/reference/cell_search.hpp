#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <pairsum/core/vec.hpp>
#include <pairsum/particles/particle_set.hpp>

namespace pairsum {

/// The reference's own search: particles sorted by a cell number that no grid of the library shares; a row of three
/// cells is one range, unless it goes through a face.
template <int D, class R>
struct cell_search_of {
  std::vector<std::pair<std::array<std::int64_t, D>, std::uint32_t>> sorted;  // (z, y, x), particle
  std::array<double, D> inverse_width, low{};
  std::array<std::int64_t, D> period{};  // (z, y, x); 0 along open axes
  bool closes;                           // along any axis

  cell_search_of(const std::vector<vec<D, R>>& x, const std::vector<particle_kind>& kind, R H, const box<D, R>& omega)
      : closes(omega.periodic.any()) {
    inverse_width.fill(1 / (1.01 * static_cast<double>(H)));
    for (int d = 0; d < D; ++d) {
      if (!omega.periodic[d]) continue;
      const double edge = omega.edge(d), lost = 4 * edge * static_cast<double>(std::numeric_limits<R>::epsilon());
      low[d] = omega.low[d];
      period[D - 1 - d] = static_cast<std::int64_t>(edge / (1.01 * static_cast<double>(H) + lost));
      inverse_width[d] = static_cast<double>(period[D - 1 - d]) / edge;
    }
    sorted.reserve(x.size());
    for (std::uint32_t i = 0; i < x.size(); ++i)
      if (kind[i] != particle_kind::lost) sorted.emplace_back(cell(x[i]), i);
    std::ranges::sort(sorted);
  }
  std::array<std::int64_t, D> cell(const vec<D, R>& x) const {
    std::array<std::int64_t, D> c;
    for (int d = 0; d < D; ++d)
      c[D - 1 - d] = static_cast<std::int64_t>(std::floor((static_cast<double>(x[d]) - low[d]) * inverse_width[d]));
    for (int d = 0; d < D; ++d)
      if (period[d] > 0) c[d] = std::clamp<std::int64_t>(c[d], 0, period[d] - 1);
    return c;
  }
  /// The cells around `own`, each once: there may be fewer than three along a periodic axis.
  template <class Meet>
  void around_in_torus(const std::array<std::int64_t, D>& own, Meet&& meet) const {
    std::array<std::vector<std::int64_t>, D> axis;
    for (int d = 0; d < D; ++d) {
      for (std::int64_t step = -1; step <= 1; ++step)
        axis[d].push_back(period[d] > 0 ? (own[d] + step + period[d]) % period[d] : own[d] + step);
      std::ranges::sort(axis[d]);
      axis[d].erase(std::unique(axis[d].begin(), axis[d].end()), axis[d].end());
    }
    std::size_t cells = 1;
    for (const auto& a : axis) cells *= a.size();
    for (std::size_t number = 0; number < cells; ++number) {
      std::array<std::int64_t, D> at;
      std::size_t code = number;
      for (int d = 0; d < D; code /= axis[d].size(), ++d) at[d] = axis[d][code % axis[d].size()];
      auto k = std::ranges::lower_bound(sorted, at, {}, [](const auto& s) { return s.first; });
      for (; k != sorted.end() && k->first == at; ++k) meet(k->second);
    }
  }
  template <class Meet>
  void around(const vec<D, R>& x, Meet&& meet) const {
    const auto own = cell(x);
    if (closes) return around_in_torus(own, meet);
    std::size_t rows = 1;
    for (int d = 1; d < D; ++d) rows *= 3;
    for (std::size_t row = 0; row < rows; ++row) {
      auto low = own;
      std::size_t code = row;
      for (int d = 0; d < D - 1; ++d, code /= 3) low[d] += static_cast<std::int64_t>(code % 3) - 1;
      auto high = low;
      low[D - 1] -= 1;
      high[D - 1] += 1;
      auto at = std::ranges::lower_bound(sorted, low, {}, [](const auto& s) { return s.first; });
      for (; at != sorted.end() && at->first <= high; ++at) meet(at->second);
    }
  }
};

}  // namespace pairsum

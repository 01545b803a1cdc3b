#include <pairsum/files/nearest_spacing.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace pairsum::files {

// Points are sorted along the longest axis. From each of the chosen ones the search goes up and down that axis, until
// what is left is farther away along it than the nearest found.
double nearest_spacing(std::span<const std::vector<double>* const> x) {
  constexpr std::size_t most = 400;
  const std::size_t n = x.empty() ? 0 : x[0]->size();
  if (n < 2) return 0;
  const auto extent = [](const std::vector<double>* c) {
    const auto [low, high] = std::ranges::minmax_element(*c);
    return *high - *low;
  };
  const std::vector<double>& along = **std::ranges::max_element(x, {}, extent);
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return along[i]; });
  std::vector<double> found;
  for (std::size_t s = 0; s < std::min(n, most); ++s) {
    const std::size_t at = s * n / std::min(n, most), i = order[at];
    double nearest2 = std::numeric_limits<double>::infinity();
    /// Is the point so far away along the axis that it and those behind it need no look?
    const auto look = [&](std::size_t k) {
      const std::size_t j = order[k];
      const double away = along[j] - along[i];
      if (away * away >= nearest2) return false;
      double r2 = 0;
      for (const auto* const c : x) r2 += ((*c)[j] - (*c)[i]) * ((*c)[j] - (*c)[i]);
      if (r2 > 0) nearest2 = std::min(nearest2, r2);
      return true;
    };
    for (std::size_t k = at + 1; k < n && look(k); ++k) {
    }
    for (std::size_t k = at; k > 0 && look(k - 1); --k) {
    }
    if (std::isfinite(nearest2)) found.push_back(std::sqrt(nearest2));
  }
  if (found.empty()) return 0;
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::ranges::nth_element(found, middle);
  return *middle;
}

}  // namespace pairsum::files

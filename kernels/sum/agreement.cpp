#include <pairsum/sum/agreement.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pairsum {

double share_of_bound(const rate_table& rates, const expectation& expected) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (rates.names != expected.names || rates.columns.size() != expected.names.size()) return infinity;
  for (const auto& column : rates.columns)
    for (const std::uint32_t id : expected.ids)
      if (id >= column.size()) return infinity;
  double largest = 0;
  for (std::size_t c = 0; c < expected.names.size(); ++c)
    for (std::size_t k = 0; k < expected.ids.size(); ++k) {
      const double distance = std::abs(rates.columns[c][expected.ids[k]] - expected.value[c][k]);
      const double bound = expected.bound[c][k];
      if (std::isnan(distance) || !std::isfinite(bound)) return infinity;
      if (distance > 0) largest = std::max(largest, distance / bound);
    }
  return largest;
}

}  // namespace pairsum

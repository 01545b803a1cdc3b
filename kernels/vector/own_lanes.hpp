#pragma once
// For a user's own interactions: the vector units that the source is compiled for.
#include <pairsum/core/isa.hpp>
#include <pairsum/formula/lanes_of.hpp>
#include <pairsum/vector/compiled_lanes.hpp>

namespace pairsum {

template <class I>
std::vector<lane_sum<I::dim, typename I::real>> lanes_of() {
  std::vector<lane_sum<I::dim, typename I::real>> all;
#if PAIRSUM_LANES
  if constexpr (takes_lanes<I>)
    for (const std::string_view isa : isa_names())
      if (isa == compiled_vector_isa()) all.push_back(row_rates<I>::completed(compiled_lanes<I>(isa)));
#endif
  return all;
}

}  // namespace pairsum

#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <pairsum/core/error.hpp>

namespace pairsum::ranks {

/// Where in `ids` the wanted ones are, which are all among them; some may be wanted several times. Few are wanted of
/// many.
inline std::vector<std::uint32_t> places_of_ids(std::span<const std::uint32_t> ids,
                                                std::span<const std::uint32_t> wanted) {
  constexpr std::uint32_t bits = 1u << 20;
  std::vector<bool> may_be(bits, false);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_id(wanted.size());  // id, which of the wanted
  for (std::uint32_t k = 0; k < wanted.size(); ++k) {
    by_id[k] = {wanted[k], k};
    may_be[wanted[k] % bits] = true;
  }
  std::ranges::sort(by_id);
  constexpr std::uint32_t nowhere = ~0u;
  std::vector<std::uint32_t> place(wanted.size(), nowhere);
  for (std::uint32_t i = 0; i < ids.size(); ++i) {
    if (!may_be[ids[i] % bits]) continue;
    for (auto at = std::ranges::lower_bound(by_id, std::pair{ids[i], 0u}); at != by_id.end() && at->first == ids[i];
         ++at)
      place[at->second] = i;
  }
  if (std::ranges::count(place, nowhere) > 0) throw error("a particle of the halo is not where it was");
  return place;
}

}  // namespace pairsum::ranks

#pragma once
#include <string_view>

#include <pairsum/sum/meeting.hpp>
#include <pairsum/sum/pair_sum.hpp>
#include <pairsum/sum/search_space.hpp>

namespace pairsum {

/// Lists rows on the vector units of one instruction set. Fluid partners may be slightly beyond the cutoff: the sum
/// decides in the working precision. Behind a row's fluid partners are row_padding more, numbers from `spare` on.
template <int D>
struct vector_lister {
  std::string_view isa;
  /// `order`: which particle is number k of the places; nullptr: number k.
  void (*list)(const lane_places<D>&, const std::uint32_t* order, const row_sink&, const meeting<D>*, unsigned n);
};

/// The listers that this machine runs, best first.
template <int D>
std::span<const vector_lister<D>> vector_listers();

}  // namespace pairsum

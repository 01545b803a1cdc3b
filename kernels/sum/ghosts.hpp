#pragma once
#include <cstdint>

#include <pairsum/core/column.hpp>
#include <pairsum/core/team.hpp>
#include <pairsum/grid/cells.hpp>
#include <pairsum/particles/particle_set.hpp>

namespace pairsum {

struct row;

/// Who sums a pair of an own particle and a ghost.
enum class cut_pairs : std::uint8_t {
  none,   ///< there are no ghosts
  twice,  ///< each rank the side of its own particle; what a sum adds to ghosts means nothing
  once,   ///< one of the two ranks both sides; what it adds to ghosts goes back to their owners
};

/// The ghosts among the fluid of a sorted set: copies of particles that other ranks own, and all that listers know of
/// them. In each cell they lie behind the own fluid. Pairs of two ghosts are never tested.
struct ghost_marks {
  cut_pairs pairs = cut_pairs::none;
  const particle_kind* kind = nullptr;
  const std::uint32_t* id = nullptr;  ///< the same on every rank
  column<std::uint32_t> before;       ///< ghosts among the first k particles
  column<std::uint8_t> near;          ///< by cell: has it, or one around it, ghosts?

  /// Looks at the first `fluid` particles. Throws pairsum::error if a cell's own fluid is not before its ghosts.
  template <int D>
  void mark(const cells<D>& c, std::size_t fluid, const team& t);
  /// Are there any?
  bool any() const { return pairs != cut_pairs::none && before.back() > 0; }

  bool is_ghost(std::uint32_t i) const { return kind[i] == particle_kind::ghost; }
  std::uint32_t ghosts_in(const index_range& r) const { return before[r.end] - before[r.begin]; }

  /// Mode `once`: is the pair of own particle i and ghost j summed here? Both ranks find the same answer, since it
  /// depends on the two ids alone: a hash of both picks the lower or the higher one, whose owner sums. (By position,
  /// one side of a border would have all the work, and coincident particles nobody.)
  bool is_ours(std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t picks_higher = (id[i] + id[j]) * 0x9e3779b1u >> 31;
    return (id[i] < id[j]) != static_cast<bool>(picks_higher);
  }
  /// Is the pair of i and j, not both ghosts, summed here?
  bool is_summed(std::uint32_t i, std::uint32_t j) const {
    if (pairs != cut_pairs::once || is_ghost(i) == is_ghost(j)) return true;
    return is_ghost(i) ? is_ours(j, i) : is_ours(i, j);
  }
};

}  // namespace pairsum

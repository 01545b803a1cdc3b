#pragma once
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <pairsum/core/team.hpp>
#include <pairsum/grid/cell_scale.hpp>
#include <pairsum/particles/particle_set.hpp>

namespace pairsum {

/// A cell by its coordinates, 64 bits each; in order of the last component, then the one before, x varying fastest.
template <int D>
struct cell_place {
  ivec<D> c;

  bool operator==(const cell_place&) const = default;
  std::strong_ordering operator<=>(const cell_place& o) const {
    for (int d = D - 1; d > 0; --d)
      if (c[d] != o.c[d]) return c[d] <=> o.c[d];
    return c[0] <=> o.c[0];
  }
};

/// The cells that particles are in, ascending, in however large a domain: memory grows with the cells that hold
/// particles alone. A cell's rank in the list is its number.
template <int D, class R>
class cell_list {
 public:
  /// Lists the cells of the particles that are summed: inside Omega and not lost. The first `moved` particles, or all,
  /// may be others than in the last call. Returns whether the list changed.
  bool fit(const particle_set<D, R>& p, std::size_t moved, const box<D, R>& omega, const cell_scale<D, R>& scale,
           const team& t);

  std::span<const cell_place<D>> places() const { return places_; }
  /// Writes the ranks of particles begin..end, whose cells are listed (else the rank does not matter), to out[0..].
  void ranks(const particle_set<D, R>& p, std::size_t begin, std::size_t end, const cell_scale<D, R>& scale,
             std::span<std::uint32_t> out) const;

 private:
  std::size_t rest_begin_ = ~std::size_t{0};
  std::vector<cell_place<D>> places_, rest_;  ///< rest_: of the particles from rest_begin_ on
};

}  // namespace pairsum

#pragma once
#include <array>
#include <cstdint>

#include <pairsum/core/torus.hpp>

namespace pairsum {

struct ghost_marks;

/// The positions of the sorted set, a column per component.
template <int D, class R>
struct positions {
  std::array<const R*, D> column{};
  torus<D, R> omega{};  ///< makes minimum-image displacements of differences where the domain is periodic

  [[gnu::always_inline]] vec<D, R> operator[](std::size_t i) const {
    vec<D, R> p;
    for (int d = 0; d < D; ++d) p[d] = column[d][i];
    return p;
  }
  /// The same as a point whose differences from others are displacements, also through the faces of a periodic box.
  [[gnu::always_inline]] point<D, R> point_of(std::size_t i) const {
    const vec<D, R> p = (*this)[i];
    return {p, omega.seen_from(p)};
  }
};

/// Places are fixed-point positions: integers modulo 2^32, so many per cutoff. Differences of particles less than 2048
/// cutoffs apart are exact. Along a periodic axis 2^32 of them make the edge, so that differences are minimum images.
inline constexpr std::int32_t places_per_reach = 1 << 20;
/// Columns of places can be read so far behind their end.
inline constexpr std::size_t place_room = 32;

/// The positions as vector units search them (sum/lane_rows.hpp makes them).
template <int D>
struct lane_places {
  std::array<const std::int32_t*, D> place{};  ///< [particle]; rounded to the nearest
  float excess = 0;  ///< how far, in units of the search radius squared, rounding to places can move |x_i - x_j|^2
  float boundary_reach = 0;           ///< in units of the search radius, at most 1
  bool periodic = false;              ///< along any axis
  std::array<float, D> place_size{};  ///< if periodic: units of 2^-20 search radii that a place takes, per axis
  std::array<float, D> half_edge{};   ///< half the edges in such units; infinite along open axes
};

/// The positions of a search's candidates, and its cutoffs.
template <int D, class R>
struct search_space {
  positions<D, R> x;
  R reach2 = 0, boundary_reach2 = 0;     ///< squares of the cutoffs, m2; a boundary_reach2 of 0: boundary does nothing
  const std::uint32_t* order = nullptr;  ///< which particle is number k of x; nullptr: number k
  const ghost_marks* ghosts = nullptr;   ///< nullptr: there are none
  lane_places<D> places;                 ///< the same for vector units
};

}  // namespace pairsum

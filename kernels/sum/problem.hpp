#pragma once
#include <array>

#include "core/torus.hpp"
#include "grid/cells.hpp"
#include "interactions/interaction.hpp"
#include "particles/particle_set.hpp"

namespace pairsum {

/// The positions of the sorted set, a column per component.
template <int D, class R>
struct positions {
  std::array<const R*, D> column;
  torus<D, R> omega{};  ///< what makes ways of differences if Omega is periodic

  [[gnu::always_inline]] vec<D, R> operator[](std::size_t i) const {
    vec<D, R> p;
    for (int d = 0; d < D; ++d) p[d] = column[d][i];
    return p;
  }
  /// The same as a point whose differences from others are ways, also through the faces of a periodic box.
  [[gnu::always_inline]] point<D, R> point_of(std::size_t i) const {
    const vec<D, R> p = (*this)[i];
    return {p, omega.seen_from(p)};
  }
};

/// Everything a backend sees of one summation: sorted particles as columns, the cells they lie in, the formula, and
/// where the rates go. Indices are positions in the sorted set: fluid [0, fluid_count), boundary behind it. Nothing
/// here is owned.
template <interaction I>
struct problem {
  using real = typename I::real;
  static constexpr int dim = I::dim;

  positions<dim, real> x;                            ///< all particles
  field_pointers<particle_of<I>> fluid;              ///< index: fluid particle
  field_pointers<boundary_particle_of<I>> boundary;  ///< read it through boundary_particle(b)
  field_pointers<rates_of<I>> u;                     ///< index: fluid particle
  const pairsum::cells<dim>* grid_cells;
  const I* formula;
  real reach2, boundary_reach2;              ///< H^2 and (boundary_reach H)^2
  std::size_t fluid_count, count;            ///< fluid, and with the boundary
  const particle_set<dim, real>* particles;  ///< the sorted set

  const pairsum::cells<dim>& cells() const { return *grid_cells; }

  /// What boundary particle b brings, b being its position in the sorted set.
  [[gnu::always_inline]] boundary_particle_of<I> boundary_particle(std::size_t b) const {
    return boundary.load(b - fluid_count);
  }
  /// Where particle i is. position(i) - position(j) is the way from j to i, in a periodic box the shortest.
  [[gnu::always_inline]] point<dim, real> position(std::size_t i) const { return x.point_of(i); }
};

}  // namespace pairsum

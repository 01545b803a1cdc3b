#pragma once
#include <pairsum/interactions/interaction.hpp>
#include <pairsum/sum/problem.hpp>

namespace pairsum {

/// A formula with the columns that its pairs read: what problem::formula points to.
template <class I>
struct formula_view {
  const I* formula;
  field_pointers<particle_of<I>> fluid;              ///< index: fluid particle
  field_pointers<boundary_particle_of<I>> boundary;  ///< index: boundary particle, from 0

  static const formula_view& of(const problem<I::dim, typename I::real>& p) {
    return *static_cast<const formula_view*>(p.formula);
  }
};

}  // namespace pairsum

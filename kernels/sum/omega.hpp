#pragma once
#include <pairsum/core/torus.hpp>
#include <pairsum/sum/setup.hpp>

namespace pairsum {

/// Omega in the working precision, rounded outwards, so that no particle inside it is outside after rounding.
template <int D, class R>
box<D, R> make_box(const setup& s);
/// Axis d of it.
template <class R>
box<1, R> make_box_of_axis(const setup& s, std::size_t d);

/// How displacements in Omega are computed, in the working precision; `skin`: of lists of pairs, in units of H.
template <int D, class R>
torus<D, R> make_torus(const setup& s, double skin = 0) {
  return {make_box<D, R>(s), static_cast<R>(s.constants.H * (1 + skin))};
}

}  // namespace pairsum

#pragma once
#include <concepts>
#include <cstdint>
#include <string_view>

#include "core/fields.hpp"
#include "eos/tait.hpp"

namespace pairsum {

/// Constants of the formulas, SI units.
struct physics {
  double H = 0;  ///< support radius, m
  tait eos;
};

/// One particle's state as an interaction's `derive` sees it.
template <int D, class T>
struct particle_state {
  vec<D, T> x, v;  ///< m, m/s
  T rho, m;        ///< kg/m3, kg
  std::uint32_t id;
};

/// What one pair adds to its two particles.
template <class Rates>
struct contributions {
  Rates to_i, to_j;
};

/// A pair interaction (the f of the talk). T is a scalar, a vector of lanes, or a value that carries an error bound.
///
///   particle<T>            what a fluid particle brings to a pair, derived once per summation by derive()
///   boundary_particle<T>   the same for a boundary particle, by derive_boundary()
///   rates<T>               what is summed
///   pair(r, r2, i, j)      both contributions of a fluid pair; r = x_i - x_j, r2 = r.r < H^2; a backend that wants one
///   side takes
///                          .to_i and the compiler drops the rest
///   boundary(r, r2, i, b)  what boundary particle b adds to fluid particle i, for r2 < (boundary_reach H)^2
template <class I>
concept interaction = requires(const I& f, const particle_state<I::dim, typename I::real>& s,
                               const vec<I::dim, typename I::real>& r, typename I::real r2,
                               const typename I::template particle<typename I::real>& i,
                               const typename I::template boundary_particle<typename I::real>& b) {
  { I::name } -> std::convertible_to<std::string_view>;
  { I::boundary_reach } -> std::convertible_to<double>;
  { f.derive(s) } -> std::same_as<typename I::template particle<typename I::real>>;
  { f.derive_boundary(s) } -> std::same_as<typename I::template boundary_particle<typename I::real>>;
  { f.pair(r, r2, i, i).to_j } -> std::convertible_to<typename I::template rates<typename I::real>>;
  { f.boundary(r, r2, i, b) } -> std::same_as<typename I::template rates<typename I::real>>;
};

template <class I>
using particle_of = typename I::template particle<typename I::real>;
template <class I>
using boundary_particle_of = typename I::template boundary_particle<typename I::real>;
template <class I>
using rates_of = typename I::template rates<typename I::real>;

}  // namespace pairsum

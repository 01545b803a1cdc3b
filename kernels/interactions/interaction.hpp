#pragma once
#include <concepts>
#include <cstdint>
#include <string_view>
#include <tuple>

#include <pairsum/core/fields.hpp>
#include <pairsum/eos/tait.hpp>

namespace pairsum {

/// Constants of the formulas, SI units.
struct physics {
  double H = 0;  ///< support radius, m
  tait eos;
  double dx = 0;  ///< spacing of the particles, m, where it is known; else 0
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

/// Flops of an interaction's pairs, those of adding to the rates among them: + - * / sqrt, max, comparison, select and
/// exp count 1 each, a change of sign nothing. r and r.r are there from the distance test.
struct pair_flops {
  int both = 0;       ///< a fluid pair that updates both particles
  int one_sided = 0;  ///< a fluid pair that updates i alone, where nothing but to_i is computed
  int boundary = 0;   ///< a boundary particle's effect on a fluid particle
  bool operator==(const pair_flops&) const = default;
};

/// The data of a particle of which only the position matters.
struct nothing {
  static constexpr auto fields() { return std::tuple<>{}; }
};

/// Both contributions of a fluid pair at a distance that is known. (A formula without pair_at takes no root, or its
/// own.)
template <class I, int D, class T, class P>
contributions<typename I::template rates<T>> pair_at(const I& formula, const T& distance, const vec<D, T>& r,
                                                     const T& r2, const P& i, const P& j) {
  if constexpr (requires { formula.pair_at(distance, r, r2, i, j); })
    return formula.pair_at(distance, r, r2, i, j);
  else
    return formula.pair(r, r2, i, j);
}

/// Does I say what a boundary particle does to a fluid particle?
template <class I>
concept has_boundary = requires {
  typename I::template boundary_particle<typename I::real>;
};

/// A pair interaction (the f of the talk). T is a scalar, a vector of lanes, or a value that carries an error bound.
///
///   name, dim, real        the word for it, the dimension, the working precision
///   I(physics)             takes the constants
///   particle<T>            the data of a fluid particle that a pair needs, derived once per summation by derive()
///   rates<T>               what is summed. Both are structs with fields(), or a single scalar or vec (core/fields.hpp)
///   rate_name              the rates' name if they are a single scalar or vec; a struct has `names`
///   pair(r, r2, i, j)      both contributions of a fluid pair; r = x_i - x_j, r2 = r.r < H^2; a backend that wants one
///                          side takes .to_i and the compiler drops the rest
///
/// and, if boundary particles act on fluid particles (see has_boundary),
///
///   boundary_particle<T>   the data of a boundary particle, by derive_boundary()
///   boundary(r, r2, i, b)  what boundary particle b adds to fluid particle i, for r2 < (boundary_reach H)^2
///   boundary_reach         in (0, 1]
///   boundary_is_singular   true if there is no finite force at r = 0: such particles are refused
///
/// and, for formulas that take a square root (vector backends then take it early, since the rest waits for it),
///
///   pair_at(distance, r, r2, i, j)   pair() for distance = |r|
///
/// and, to be checked by a test,
///
///   flops                  pair_flops of the formula
template <class I>
concept interaction = requires(const I& f, const particle_state<I::dim, typename I::real>& s,
                               const vec<I::dim, typename I::real>& r, typename I::real r2,
                               const typename I::template particle<typename I::real>& i) {
  { I::name } -> std::convertible_to<std::string_view>;
  { f.derive(s) } -> std::same_as<typename I::template particle<typename I::real>>;
  { f.pair(r, r2, i, i).to_j } -> std::convertible_to<typename I::template rates<typename I::real>>;
}
&&(!has_boundary<I> ||
   requires(const I& f, const particle_state<I::dim, typename I::real>& s, const vec<I::dim, typename I::real>& r,
            typename I::real r2, const typename I::template particle<typename I::real>& i) {
     { I::boundary_reach } -> std::convertible_to<double>;
     { f.boundary(r, r2, i, f.derive_boundary(s)) } -> std::same_as<typename I::template rates<typename I::real>>;
   });

namespace interaction_detail {
template <class I, class T>
struct boundary_particle {
  using type = nothing;
};
template <has_boundary I, class T>
struct boundary_particle<I, T> {
  using type = typename I::template boundary_particle<T>;
};
}  // namespace interaction_detail

/// Cutoff of boundary particles in units of H; 0 if they do not act.
template <class I>
constexpr double boundary_reach() {
  if constexpr (has_boundary<I>)
    return I::boundary_reach;
  else
    return 0;
}

/// Must a fluid particle not lie exactly on a boundary particle?
template <class I>
constexpr bool boundary_is_singular() {
  if constexpr (requires { I::boundary_is_singular; })
    return I::boundary_is_singular;
  else
    return false;
}

template <class I>
using particle_of = typename I::template particle<typename I::real>;
template <class I>
using boundary_particle_of = typename interaction_detail::boundary_particle<I, typename I::real>::type;
template <class I>
using rates_of = typename I::template rates<typename I::real>;

}  // namespace pairsum

#pragma once
#include <string_view>
#include <type_traits>

#include <pairsum/core/precision.hpp>
#include <pairsum/sum/mixed_unit.hpp>

namespace pairsum {

/// Interaction I in mixed precision: state, derived terms and sums in I's double, the terms of fluid pairs in float.
/// For vector backends, which pack pairs of float into a vector and half the bytes into a row; boundary terms are
/// evaluated in double. Positions are fixed-point numbers with at least 2^28 steps per support radius, so that x_i -
/// x_j, exact until it becomes a float, does not lose digits far from the origin. Which pairs interact is decided in
/// double.
template <class I>
struct mixed : I {
  static_assert(std::is_same_v<typename I::real, double>);
  using I::I;
};

namespace mixed_detail {
template <class I>
struct pair_real {
  using type = typename I::real;
};
template <class I>
struct pair_real<mixed<I>> {
  using type = float;
};
}  // namespace mixed_detail

/// The precision of the terms of fluid pairs.
template <class I>
using pair_real = typename mixed_detail::pair_real<I>::type;
template <class I>
inline constexpr bool is_mixed = !std::is_same_v<pair_real<I>, typename I::real>;

/// The word for I's precision.
template <class I>
constexpr std::string_view precision_of() {
  return is_mixed<I> ? mixed_precision : precision_name<typename I::real>();
}

}  // namespace pairsum

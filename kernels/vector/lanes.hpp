#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <type_traits>

#include <pairsum/core/value.hpp>
#include <pairsum/vector/exponential.hpp>
#include <pairsum/vector/highway.hpp>
#include <pairsum/vector/root.hpp>

/// A vector of lanes as a value type for formulas: + - * / and the operations of core/value.hpp, found by
/// argument-dependent lookup. V is one of Highway's vectors, whose namespace names the instruction set; so what is
/// compiled for one set is never taken for another's by the linker, as long as V is part of its type.
namespace pairsum {

namespace hn = hwy::HWY_NAMESPACE;

template <class R>
using lane_tag = hn::ScalableTag<R>;
template <class R>
using lane_vector = hn::Vec<lane_tag<R>>;
/// Lanes of R in a vector of the instruction set this is compiled for.
template <class R>
inline constexpr std::size_t lane_count = hn::MaxLanes(lane_tag<R>());

/// first, first + 1, ... Highway's Iota of a number that is unknown when compiling writes lane after lane to memory and
/// loads them as a vector, which has to wait for them all. With 16 lanes adding to a constant is quicker; with few it
/// is slower (by 10 % of a sum with SSE4).
template <class D>
HWY_INLINE hn::Vec<D> numbered_from(D d, std::size_t first) {
  const auto from = static_cast<hn::TFromD<D>>(first);
  if constexpr (HWY_CAP_GE512)
    return hn::Add(hn::Iota(d, 0), hn::Set(d, from));
  else
    return hn::Iota(d, from);
}

template <class V>
struct lanes {
  using real = hn::TFromV<V>;
  using tag = hn::DFromV<V>;
  using mask = hn::Mask<tag>;
  V v;

  lanes() = default;
  HWY_INLINE lanes(V vector) : v(vector) {}  // NOLINT: the same thing
  template <class N>
  requires std::is_arithmetic_v<N> HWY_INLINE lanes(N value)  // NOLINT: constants convert
      : v(hn::Set(tag(), static_cast<real>(value))) {}

  friend HWY_INLINE lanes operator+(lanes a, lanes b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE lanes operator-(lanes a, lanes b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE lanes operator*(lanes a, lanes b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE lanes operator/(lanes a, lanes b) { return hn::Div(a.v, b.v); }
  HWY_INLINE lanes operator-() const { return hn::Neg(v); }
  HWY_INLINE lanes& operator+=(lanes b) { return *this = *this + b; }
  HWY_INLINE lanes& operator-=(lanes b) { return *this = *this - b; }
  HWY_INLINE lanes& operator*=(lanes b) { return *this = *this * b; }
  HWY_INLINE lanes& operator/=(lanes b) { return *this = *this / b; }

  friend HWY_INLINE mask operator<(lanes a, lanes b) { return hn::Lt(a.v, b.v); }
  friend HWY_INLINE mask operator==(lanes a, lanes b) { return hn::Eq(a.v, b.v); }

  friend HWY_INLINE lanes select(mask m, lanes a, lanes b) { return hn::IfThenElse(m, a.v, b.v); }
  friend HWY_INLINE lanes square_root(lanes a) { return root_of(tag(), a.v); }
  friend HWY_INLINE lanes exponential(lanes a) { return exponential_of(tag(), a.v); }
  friend HWY_INLINE lanes maximum(lanes a, lanes b) { return hn::Max(a.v, b.v); }
  friend HWY_INLINE lanes absolute(lanes a) { return hn::Abs(a.v); }
  friend HWY_INLINE lanes fused(lanes a, lanes b, lanes c) { return hn::MulAdd(a.v, b.v, c.v); }
};

}  // namespace pairsum

namespace Eigen {
template <class V>
struct NumTraits<pairsum::lanes<V>> : NumTraits<typename pairsum::lanes<V>::real> {
  using Real = pairsum::lanes<V>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = typename Real::real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
}  // namespace Eigen

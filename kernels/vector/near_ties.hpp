#pragma once
#include <pairsum/sum/lane_rows.hpp>
#include <pairsum/sum/problem.hpp>
#include <pairsum/vector/lanes.hpp>

namespace pairsum {

/// Replaces `in` in the lanes that are `close` by what scalar code decides.
template <int D, class R, class Mask>
HWY_NOINLINE Mask decide_lanes(const problem<D, R>& p, Mask in, Mask close, R reach2, std::uint32_t i,
                               const std::uint32_t* other, auto d) {
  using real = hn::TFromD<decltype(d)>;
  constexpr std::size_t N = lane_count<real>;
  HWY_ALIGN real is_in[N], is_close[N];
  hn::Store(hn::IfThenElseZero(in, hn::Set(d, real(1))), d, is_in);
  hn::Store(hn::IfThenElseZero(close, hn::Set(d, real(1))), d, is_close);
  for (std::size_t l = 0; l < N; ++l)
    if (is_close[l] > 0) is_in[l] = p.lane->in_reach(p.x, i, other[l], reach2) ? real(1) : real(0);
  return hn::Gt(hn::Load(d, is_in), hn::Zero(d));
}

/// Corrects `in`, the lanes with r2 < reach2, where r2 is so near that rounding decides. other[l] is the particle in
/// lane l; a lane that is not in and far from the cutoff is left alone.
template <int D, class R, class V, class Mask>
HWY_INLINE Mask decide_near_ties(const problem<D, R>& p, Mask in, V r2, R reach2, std::uint32_t i,
                                 const std::uint32_t* other) {
  using real = hn::TFromV<V>;
  const lane_tag<real> d;
  const auto reach = static_cast<real>(reach2);
  const auto close =
      hn::Lt(hn::Abs(hn::Sub(r2, hn::Set(d, reach))), hn::Set(d, static_cast<real>(p.lane->tie) * reach));
  if (hn::AllFalse(d, close)) [[likely]]
    return in;
  return decide_lanes(p, in, close, reach2, i, other, d);
}

/// Components of displacements, an edge shorter where they go through a face of a periodic box: as
/// torus::to_minimum_image() rounds.
template <class V, class R>
HWY_INLINE V shortest_lanes(V r, R edge) {
  const hn::DFromV<V> d;
  const auto through = hn::Gt(hn::Abs(r), hn::Set(d, edge / 2));
  return hn::Sub(r, hn::IfThenElseZero(through, hn::CopySignToAbs(hn::Set(d, edge), r)));
}

/// Numbers of particles as lanes as wide as the working precision.
template <class T, class N>
HWY_INLINE hn::Vec<T> as_lanes(T d, N numbers) {
  if constexpr (sizeof(hn::TFromD<T>) == 4)
    return hn::BitCast(d, numbers);
  else
    return hn::BitCast(d, hn::PromoteTo(hn::RebindToUnsigned<T>(), numbers));
}

}  // namespace pairsum

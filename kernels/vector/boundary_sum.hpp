#pragma once
#include "vector/hit_batch.hpp"

namespace pairsum {

/// u += what boundary particles b[0 .. n) within reach do to fluid particle i. These pairs are few, so their particles
/// are gathered from their columns.
template <class I, class V>
HWY_INLINE void add_boundary_lanes(const tile_problem<I>& t, std::uint32_t i, const std::uint32_t* b, std::size_t n,
                                   V (&u)[tile_problem<I>::rates]) {
  using real = typename I::real;
  using T = lanes<V>;
  using whole = hwy::MakeSigned<real>;
  constexpr int D = I::dim;
  constexpr std::size_t N = lane_count<real>;
  const problem<I>& p = *t.p;
  const lane_tag<real> d;
  const hn::RebindToSigned<lane_tag<real>> di;
  const real* const row = t.rows + i * tile_problem<I>::stride;
  const auto one = particle_at<I, T>(row);
  for (std::size_t k = 0; k < n; k += N) {
    HWY_ALIGN whole lane[N];
    std::uint32_t near[N];
    for (std::size_t l = 0; l < N; ++l) lane[l] = static_cast<whole>(near[l] = b[k + l < n ? k + l : k]);
    const auto place = hn::Load(di, lane);
    const auto from = hn::Sub(place, hn::Set(di, static_cast<whole>(p.fluid_count)));
    vec<D, T> r;
    for (int c = 0; c < D; ++c) r[c] = T(row[c]) - T(hn::GatherIndex(d, p.x.column[c], place));
    typename I::template boundary_particle<T> wall;
    each_scalar(wall,
                [&](T& v, int s) HWY_ATTR { v = T(hn::GatherIndex(d, p.boundary.template column_as<real>(s), from)); });
    const T r2 = norm2<D, T>(r);
    auto in = hn::Lt(r2.v, hn::Set(d, p.boundary_reach2));
    if (t.in_reach != nullptr) in = decide_near_ties(t, in, r2.v, p.boundary_reach2, i, near);
    if (n - k < N) in = hn::And(in, hn::FirstN(d, n - k));
    const auto rates = p.formula->boundary(r, r2, one, wall);
    each_scalar(rates, [&](const T& v, int s) HWY_ATTR { u[s] = hn::Add(u[s], hn::IfThenElseZero(in, v.v)); });
  }
}

}  // namespace pairsum

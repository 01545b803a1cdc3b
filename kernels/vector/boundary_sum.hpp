#pragma once
#include "vector/hit_batch.hpp"

namespace pairsum {

/// Numbers of particles as lanes as wide as the working precision.
template <class T, class N>
HWY_INLINE hn::Vec<T> as_lanes(T d, N numbers) {
  if constexpr (sizeof(hn::TFromD<T>) == 4)
    return hn::BitCast(d, numbers);
  else
    return hn::BitCast(d, hn::PromoteTo(hn::RebindToUnsigned<T>(), numbers));
}

/// u += what boundary particles b[0 .. n) within reach do to fluid particle i; a whole vector can be read from every b.
/// These pairs are few, so their particles are gathered from their columns, and always summed in I's own precision.
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
  const hn::Rebind<std::uint32_t, lane_tag<real>> dn;
  const pair_real<I>* const row = t.row(i);
  const auto one = particle_at<I, T>(row);
  for (std::size_t k = 0; k < n; k += N) {
    // Behind the last hit the first stands in, out of reach.
    const auto hit = hn::IfThenElse(hn::FirstN(dn, n - k), hn::LoadU(dn, b + k), hn::Set(dn, b[k]));
    const auto place = as_lanes(di, hit);
    const auto from = hn::Sub(place, hn::Set(di, static_cast<whole>(p.fluid_count)));
    vec<D, T> r;
    for (int c = 0; c < D; ++c) {
      const real x_i = is_mixed<I> ? p.x.column[c][i] : static_cast<real>(row[c]);
      r[c] = T(x_i) - T(hn::GatherIndex(d, p.x.column[c], place));
      if (t.periodic) [[unlikely]]
        r[c] = shortest_lanes(r[c].v, p.x.omega.edge[c]);
    }
    typename I::template boundary_particle<T> wall;
    each_scalar(wall,
                [&](T& v, int s) HWY_ATTR { v = T(hn::GatherIndex(d, p.boundary.template column_as<real>(s), from)); });
    const T r2 = norm2<D, T>(r);
    auto in = hn::Lt(r2.v, hn::Set(d, p.boundary_reach2));
    if (t.in_reach != nullptr) {
      std::uint32_t other[N];
      hn::StoreU(hit, dn, other);
      in = decide_near_ties(t, in, r2.v, p.boundary_reach2, i, other);
    }
    if (n - k < N) in = hn::And(in, hn::FirstN(d, n - k));
    const auto rates = p.formula->boundary(r, r2, one, wall);
    each_scalar(rates, [&](const T& v, int s) HWY_ATTR { u[s] = hn::Add(u[s], hn::IfThenElseZero(in, v.v)); });
  }
}

}  // namespace pairsum

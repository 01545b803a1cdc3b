#pragma once
#include <algorithm>
#include <limits>

#include "vector/rows.hpp"

namespace pairsum {

/// What the particle of a row brings to a pair, in every lane.
template <class I, class T>
HWY_INLINE typename I::template particle<T> particle_at(const pair_real<I>* row) {
  typename I::template particle<T> a;
  each_scalar(a, [&](T& v, int k) HWY_ATTR { v = T(row[I::dim + k]); });
  return a;
}

/// Adds the sums over the lanes of u to the rates of particle i: those of its row, if pairs are computed once, else the
/// columns.
template <bool symmetric, class I, class V>
HWY_INLINE void add_sums(const tile_problem<I>& t, std::uint32_t i, const V (&u)[tile_problem<I>::rates]) {
  using tiles = tile_problem<I>;
  using real = typename I::real;
  if constexpr (symmetric) {
    add_sums_to_row(t.rates_of_row(i), u);
  } else {
    HWY_ALIGN real row[padded(tiles::rates)] = {};
    add_sums_to_row(row, u);
    for (std::size_t s = 0; s < tiles::rates; ++s) t.p->u.template column_as<real>(s)[i] += row[s];
  }
}

/// Replaces `in` in the lanes that are `close` by what scalar code decides.
template <class I, class Mask>
HWY_NOINLINE Mask decide_lanes(const tile_problem<I>& t, Mask in, Mask close, typename I::real reach2, std::uint32_t i,
                               const std::uint32_t* other, auto d) {
  using real = hn::TFromD<decltype(d)>;
  constexpr std::size_t N = lane_count<real>;
  HWY_ALIGN real is_in[N], is_close[N];
  hn::Store(hn::IfThenElseZero(in, hn::Set(d, real(1))), d, is_in);
  hn::Store(hn::IfThenElseZero(close, hn::Set(d, real(1))), d, is_close);
  for (std::size_t l = 0; l < N; ++l)
    if (is_close[l] > 0) is_in[l] = t.in_reach(*t.p, i, other[l], reach2) ? real(1) : real(0);
  return hn::Gt(hn::Load(d, is_in), hn::Zero(d));
}

/// Corrects `in`, the lanes with r2 < reach2, where r2 is so near that rounding decides. other[l] is the particle in
/// lane l; a lane that is not in and far from the reach is left alone.
template <class I, class V, class Mask>
HWY_INLINE Mask decide_near_ties(const tile_problem<I>& t, Mask in, V r2, typename I::real reach2, std::uint32_t i,
                                 const std::uint32_t* other) {
  using real = hn::TFromV<V>;
  const lane_tag<real> d;
  const auto reach = static_cast<real>(reach2);
  const auto close = hn::Lt(hn::Abs(hn::Sub(r2, hn::Set(d, reach))), hn::Set(d, static_cast<real>(t.tie) * reach));
  if (hn::AllFalse(d, close)) [[likely]]
    return in;
  return decide_lanes(t, in, close, reach2, i, other, d);
}

/// The hits of a few particles i, each list filled up to whole vectors with spare rows, and their sums. Vectors of
/// different i follow each other without a branch that depends on how many hits an i has. A few of them at a time go
/// through three short loops,
///
///   load, transpose, r, r2, |r|      in_[vector]
///   formula; u_i += to_i             out_[vector], sums_[i]
///   u_j += to_j
///
/// because a core waits for so many instructions at most: in one loop, those behind the root would fill it.
template <class I, class V>
class alignas(4096) hit_batch {
  using tiles = tile_problem<I>;
  using real = typename tiles::value;
  using sum_real = typename tiles::real;
  using T = lanes<V>;
  using W = lane_vector<sum_real>;
  static constexpr int D = I::dim;
  static constexpr std::size_t N = lane_count<real>, K = tiles::values, S = tiles::rates;
  using particle = typename I::template particle<T>;
  using index_tag = lane_tag<std::uint32_t>;

 public:
  hit_batch(const tiles& t, std::uint32_t spare) : t_(t), spare_(spare) {}

  /// How many particles with up to so many hits each there is room for.
  static std::size_t particles_for(std::size_t hits) { return std::min(most, capacity / (hits + 2 * padding)); }
  std::uint32_t* free() { return hits_ + vectors_ * N; }

  /// Makes [free(), end) the hits of particle i.
  HWY_INLINE void add(std::uint32_t i, std::uint32_t* end) {
    const index_tag d;
    constexpr std::size_t L = hn::MaxLanes(d);
    for (std::size_t k = 0; k < N; k += L) hn::StoreU(numbered_from(d, spare_ + k), d, end + k);
    const std::size_t vectors = (static_cast<std::size_t>(end - free()) + N - 1) / N;
    for (std::size_t k = 0; k < vectors; k += L) {
      hn::StoreU(hn::Set(d, static_cast<std::uint32_t>(n_)), d, of_ + vectors_ + k);
      hn::StoreU(hn::Set(d, ~0u), d, goes_on_ + vectors_ + k);
    }
    goes_on_[vectors_] = 0;
    vectors_ += vectors;
    particles_[n_] = i;
    n_ += vectors > 0;
  }

  /// Sums all pairs; then the batch is empty.
  template <bool symmetric>
  HWY_INLINE void flush() {
    const lane_tag<real> d;
    const lane_tag<sum_real> wide;
    W u[S];
    for (W& of_rate : u) of_rate = hn::Zero(wide);
    for (std::size_t first = 0; first < vectors_; first += chunk) {
      const std::size_t n = std::min(chunk, vectors_ - first);
      for (std::size_t k = 0; k < n; ++k) load(first + k, in_[k]);
      for (std::size_t k = 0; k < n; ++k) sum_vector<symmetric>(first + k, in_[k], u, out_[k]);
      if constexpr (symmetric)
        for (std::size_t k = 0; k < n; ++k) {
          V to_j[S];
          for (std::size_t s = 0; s < S; ++s) to_j[s] = hn::Load(d, out_[k][s]);
          add_to_rows<real>(t_.rates_of_row(0), tiles::rates_stride, hits_ + (first + k) * N, to_j);
        }
    }
    for (std::size_t k = 0; k < n_; ++k) {
      for (std::size_t s = 0; s < S; ++s) u[s] = hn::Load(wide, sums_[k][s]);
      add_sums<symmetric>(t_, particles_[k], u);
    }
    vectors_ = n_ = 0;
  }

 private:
  static constexpr std::size_t capacity = 2048, most = 32, padding = 16, chunk = 8;
  /// A vector of pairs, a lane each: r, what j brings, then r2 and |r|.
  using pair_lanes = real[K + 2][N];
  using rate_lanes = real[S][N];
  using sum_lanes = sum_real[S][lane_count<sum_real>];

  const real* row_of(std::size_t vector) const { return t_.row(particles_[of_[vector]]); }

  HWY_INLINE void load(std::size_t vector, pair_lanes& in) const {
    const lane_tag<real> d;
    const real* const row = row_of(vector);
    V value[K];
    load_rows(t_.row(0), tiles::stride, hits_ + vector * N, value);
    vec<D, T> r;
    T r2;
    if constexpr (is_mixed<I>) {
      const hn::RebindToSigned<lane_tag<real>> whole;
      for (int c = 0; c < D; ++c) {
        const auto from = hn::BitCast(whole, value[c]);
        const auto apart = hn::Sub(hn::BitCast(whole, hn::Set(d, row[c])), from);
        r[c] = hn::Mul(hn::ConvertTo(d, apart), hn::Set(d, t_.mixed_unit));
      }
      const auto there = hn::BitCast(whole, hn::LoadU(index_tag(), hits_ + vector * N));
      const auto is = hn::Lt(there, hn::Set(whole, static_cast<std::int32_t>(t_.p->fluid_count)));
      r2 = hn::IfThenElse(hn::RebindMask(d, is), norm2<D, T>(r).v, hn::Set(d, std::numeric_limits<real>::infinity()));
    } else {
      for (int c = 0; c < D; ++c) r[c] = T(hn::Set(d, row[c])) - T(value[c]);
      r2 = norm2<D, T>(r);
    }
    for (int c = 0; c < D; ++c) hn::Store(r[c].v, d, in[c]);
    for (std::size_t k = D; k < K; ++k) hn::Store(value[k], d, in[k]);
    hn::Store(r2.v, d, in[K]);
    hn::Store(square_root(r2).v, d, in[K + 1]);
  }

  /// u: sums of the vector's particle i if the vector before was of the same, else of that one.
  template <bool symmetric>
  HWY_INLINE void sum_vector(std::size_t vector, const pair_lanes& from, W (&u)[S], rate_lanes& to_j) {
    const problem<I>& p = *t_.p;
    const lane_tag<real> d;
    vec<D, T> r;
    for (int c = 0; c < D; ++c) r[c] = hn::Load(d, from[c]);
    particle other;
    each_scalar(other, [&](T& v, int k) HWY_ATTR { v = hn::Load(d, from[D + k]); });
    const T r2 = hn::Load(d, from[K]), distance = hn::Load(d, from[K + 1]);
    auto in = hn::Lt(r2.v, hn::Set(d, static_cast<real>(p.reach2)));
    if (t_.in_reach != nullptr)
      in = decide_near_ties(t_, in, r2.v, p.reach2, particles_[of_[vector]], hits_ + vector * N);
    const auto both = pair_at<I, D, T>(*p.formula, distance, r, r2, particle_at<I, T>(row_of(vector)), other);
    const lane_tag<sum_real> wide;
    const auto same = hn::LoadMaskBits(wide, reinterpret_cast<const std::uint8_t*>(goes_on_ + vector));
    sum_lanes& sums = sums_[of_[vector]];
    each_scalar(both.to_i, [&](const T& v, int s) HWY_ATTR {
      const W one = widened<sum_real>(hn::IfThenElseZero(in, v.v));
      u[s] = hn::IfThenElse(same, hn::Add(u[s], one), one);
      hn::Store(u[s], wide, sums[s]);
    });
    if constexpr (symmetric)
      each_scalar(both.to_j, [&](const T& v, int s) HWY_ATTR { hn::Store(hn::IfThenElseZero(in, v.v), d, to_j[s]); });
  }

  char apart_[2880];  // see nearby
  HWY_ALIGN std::uint32_t hits_[capacity];
  HWY_ALIGN pair_lanes in_[chunk];
  HWY_ALIGN rate_lanes out_[chunk];
  HWY_ALIGN sum_lanes sums_[most];
  std::uint32_t of_[capacity / N + padding];       ///< by vector: whose, of particles_
  std::uint32_t goes_on_[capacity / N + padding];  ///< by vector: all bits set if the one before is of the same
  std::uint32_t particles_[most + 1];
  const tiles& t_;
  std::uint32_t spare_;
  std::size_t vectors_ = 0, n_ = 0;
};

}  // namespace pairsum

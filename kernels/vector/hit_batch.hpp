#pragma once
#include <algorithm>
#include <limits>

#include "vector/rows.hpp"

namespace pairsum {

/// What the particle of a row brings to a pair, in every lane.
template <class I, class T>
HWY_INLINE typename I::template particle<T> particle_at(const typename I::real* row) {
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
    add_sums_to_row(t.rows + i * tiles::stride + tiles::rates_at, u);
  } else {
    HWY_ALIGN real row[padded(tiles::rates)] = {};
    add_sums_to_row(row, u);
    for (std::size_t s = 0; s < tiles::rates; ++s) t.p->u.template column_as<real>(s)[i] += row[s];
  }
}

/// Corrects `in`, the lanes with r2 < reach2, where r2 is so near that rounding decides. other[l] is the particle in
/// lane l; a lane that is not in and far from the reach is left alone.
template <class I, class V, class Mask>
HWY_NOINLINE Mask decide_near_ties(const tile_problem<I>& t, Mask in, V r2, typename I::real reach2, std::uint32_t i,
                                   const std::uint32_t* other) {
  using real = typename I::real;
  const lane_tag<real> d;
  const real near = 16 * std::numeric_limits<real>::epsilon() * reach2;
  const auto close = hn::Lt(hn::Abs(hn::Sub(r2, hn::Set(d, reach2))), hn::Set(d, near));
  if (hn::AllFalse(d, close)) return in;
  HWY_ALIGN real is_in[lane_count<real>], is_close[lane_count<real>];
  hn::Store(hn::IfThenElseZero(in, hn::Set(d, real(1))), d, is_in);
  hn::Store(hn::IfThenElseZero(close, hn::Set(d, real(1))), d, is_close);
  for (std::size_t l = 0; l < lane_count<real>; ++l)
    if (is_close[l] > 0) is_in[l] = t.in_reach(*t.p, i, other[l], reach2) ? real(1) : real(0);
  return hn::Gt(hn::Load(d, is_in), hn::Zero(d));
}

/// The hits of a few particles i, each list filled up to whole vectors with spare rows, and their sums, lane by lane.
/// Vectors of different i follow each other without a branch that depends on how many hits an i has.
template <class I, class V>
class alignas(4096) hit_batch {
  using real = typename I::real;
  using T = lanes<V>;
  using tiles = tile_problem<I>;
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
    const index_tag di;
    for (std::size_t k = 0; k < N; k += hn::MaxLanes(di))
      hn::StoreU(hn::Iota(di, static_cast<std::uint32_t>(spare_ + k)), di, end + k);
    const std::size_t vectors = (static_cast<std::size_t>(end - free()) + N - 1) / N;
    end_[n_] = vectors_ + vectors;
    vectors_ += vectors;
    particles_[n_++] = i;
  }

  /// Sums all pairs; then the batch is empty.
  template <bool symmetric>
  HWY_INLINE void flush() {
    std::size_t v = 0;
    for (std::size_t k = 0; k < n_; ++k) {
      V u[S];
      for (std::size_t s = 0; s < S; ++s) u[s] = hn::Zero(lane_tag<real>());
      const real* const row = t_.rows + particles_[k] * tiles::stride;
      for (const std::size_t end = end_[k]; v < end; ++v) sum_vector<symmetric>(v, particles_[k], row, u);
      add_sums<symmetric>(t_, particles_[k], u);
    }
    vectors_ = n_ = 0;
  }

 private:
  static constexpr std::size_t capacity = 2048, most = 32, padding = 16;

  template <bool symmetric>
  HWY_INLINE void sum_vector(std::size_t vector, std::uint32_t i, const real* row, V (&u)[S]) {
    const problem<I>& p = *t_.p;
    const lane_tag<real> d;
    const std::uint32_t* const hits = hits_ + vector * N;
    V value[K];
    load_rows(t_.rows, tiles::stride, hits, value);
    vec<D, T> r;
    for (int c = 0; c < D; ++c) r[c] = T(hn::Set(d, row[c])) - T(value[c]);
    particle other;
    each_scalar(other, [&](T& v, int k) HWY_ATTR { v = T(value[D + k]); });
    const T r2 = norm2<D, T>(r);
    auto in = hn::Lt(r2.v, hn::Set(d, p.reach2));
    if (t_.in_reach != nullptr) in = decide_near_ties(t_, in, r2.v, p.reach2, i, hits);
    const auto both = p.formula->pair(r, r2, particle_at<I, T>(row), other);
    each_scalar(both.to_i, [&](const T& v, int s) HWY_ATTR { u[s] = hn::Add(u[s], hn::IfThenElseZero(in, v.v)); });
    if constexpr (symmetric) {
      V to_j[S];
      each_scalar(both.to_j, [&](const T& v, int s) HWY_ATTR { to_j[s] = hn::IfThenElseZero(in, v.v); });
      add_to_rows(t_.rows + tiles::rates_at, tiles::stride, hits, to_j);
    }
  }

  char apart_[2880];  // see nearby
  HWY_ALIGN std::uint32_t hits_[capacity];
  std::size_t end_[most];
  std::uint32_t particles_[most];
  const tiles& t_;
  std::uint32_t spare_;
  std::size_t vectors_ = 0, n_ = 0;
};

}  // namespace pairsum

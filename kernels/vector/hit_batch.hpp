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

/// Components of ways, an edge shorter where they go through a face of a periodic box: as torus::shortest() rounds.
template <class V, class R>
HWY_INLINE V shortest_lanes(V r, R edge) {
  const hn::DFromV<V> d;
  const auto through = hn::Gt(hn::Abs(r), hn::Set(d, edge / 2));
  return hn::Sub(r, hn::IfThenElseZero(through, hn::CopySignToAbs(hn::Set(d, edge), r)));
}

/// The hits of a few particles i, each list filled up to whole vectors with spare rows, and their sums:
///
///   for i, for vectors of its hits j:
///     load, transpose, r, r2, |r|
///     formula; u_i += to_i            u_i in registers, summed over the lanes behind the last vector
///     u_j += to_j                     row by row
///
/// A core's scheduler holds fewer waiting vector instructions than two vectors of pairs have, so the loads of the next
/// one cannot begin early. Where both sides are updated and lanes have four bytes, with which half the instructions are
/// loads and transposition, these run a few vectors ahead in a loop of their own; elsewhere storing and reloading their
/// results costs more than it gains.
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
    vectors_ += (static_cast<std::size_t>(end - free()) + N - 1) / N;
    particles_[n_] = i;
    ends_[n_] = static_cast<std::uint32_t>(vectors_);
    ++n_;
  }

  /// Sums all pairs; then the batch is empty.
  template <bool symmetric>
  HWY_INLINE void flush() {
    const lane_tag<sum_real> wide;
    std::size_t v = 0;
    for (std::size_t k = 0; k < n_; ++k) {
      if (v == ends_[k]) continue;
      W u[S];
      for (W& of_rate : u) of_rate = hn::Zero(wide);
      const std::uint32_t i = particles_[k];
      const real* const row = t_.row(i);
      const auto one = particle_at<I, T>(row);
      for (; v < ends_[k]; ++v) {
        const std::uint32_t* const hits = hits_ + v * N;
        if constexpr (symmetric && ahead > 0) {
          if (v % ahead == 0) load_ahead(v, k);
          sum_vector<symmetric>(restored(ahead_[v % ahead]), hits, i, one, u);
        } else {
          sum_vector<symmetric>(loaded(hits, row), hits, i, one, u);
        }
      }
      add_sums<symmetric>(t_, i, u);
    }
    vectors_ = n_ = 0;
  }

 private:
  static constexpr std::size_t capacity = 2048, most = 32, padding = 16, ahead = sizeof(real) == 4 ? 4 : 0;
  /// A vector of pairs: r = x_i - x_j, r.r, |r|, and what j brings.
  struct pairs {
    vec<D, T> r;
    T r2, distance;
    particle other;
  };
  using stored_pairs = real[K + 2][N];

  HWY_INLINE pairs loaded(const std::uint32_t* hits, const real* row) const {
    const lane_tag<real> d;
    V value[K];
    load_rows(t_.row(0), tiles::stride, hits, value);
    pairs p;
    if constexpr (is_mixed<I>) {
      const hn::RebindToSigned<lane_tag<real>> whole;
      for (int c = 0; c < D; ++c) {
        const auto from = hn::BitCast(whole, value[c]);
        const auto apart = hn::Sub(hn::BitCast(whole, hn::Set(d, row[c])), from);
        p.r[c] = hn::Mul(hn::ConvertTo(d, apart), hn::Set(d, t_.mixed_unit[c]));
      }
      const auto there = hn::BitCast(whole, hn::LoadU(index_tag(), hits));
      const auto is = hn::Lt(there, hn::Set(whole, static_cast<std::int32_t>(t_.p->fluid_count)));
      p.r2 =
          hn::IfThenElse(hn::RebindMask(d, is), norm2<D, T>(p.r).v, hn::Set(d, std::numeric_limits<real>::infinity()));
    } else {
      for (int c = 0; c < D; ++c) p.r[c] = T(hn::Set(d, row[c])) - T(value[c]);
      if (t_.periodic) [[unlikely]]
        for (int c = 0; c < D; ++c) p.r[c] = shortest_lanes(p.r[c].v, t_.p->x.omega.edge[c]);
      p.r2 = norm2<D, T>(p.r);
    }
    p.distance = square_root(p.r2);
    each_scalar(p.other, [&](T& v, int k) HWY_ATTR { v = value[D + k]; });
    return p;
  }

  /// Loads vectors from v on, the first of them of particle number k.
  HWY_INLINE void load_ahead(std::size_t v, std::size_t k) {
    const lane_tag<real> d;
    const std::size_t end = std::min(v + ahead, vectors_);
    for (; v < end; ++v) {
      while (v == ends_[k]) ++k;
      const pairs p = loaded(hits_ + v * N, t_.row(particles_[k]));
      stored_pairs& to = ahead_[v % ahead];
      for (int c = 0; c < D; ++c) hn::Store(p.r[c].v, d, to[c]);
      each_scalar(p.other, [&](const T& value, int s) HWY_ATTR { hn::Store(value.v, d, to[D + s]); });
      hn::Store(p.r2.v, d, to[K]);
      hn::Store(p.distance.v, d, to[K + 1]);
    }
  }
  static HWY_INLINE pairs restored(const stored_pairs& from) {
    const lane_tag<real> d;
    pairs p;
    for (int c = 0; c < D; ++c) p.r[c] = hn::Load(d, from[c]);
    each_scalar(p.other, [&](T& value, int s) HWY_ATTR { value = hn::Load(d, from[D + s]); });
    p.r2 = hn::Load(d, from[K]);
    p.distance = hn::Load(d, from[K + 1]);
    return p;
  }

  /// u: sums of particle i so far.
  template <bool symmetric>
  HWY_INLINE void sum_vector(const pairs& p, const std::uint32_t* hits, std::uint32_t i, const particle& one,
                             W (&u)[S]) const {
    const lane_tag<real> d;
    const auto reach2 = t_.p->reach2;
    auto in = hn::Lt(p.r2.v, hn::Set(d, static_cast<real>(reach2)));
    if (t_.in_reach != nullptr) in = decide_near_ties(t_, in, p.r2.v, reach2, i, hits);
    const auto both = pair_at<I, D, T>(*t_.p->formula, p.distance, p.r, p.r2, one, p.other);
    each_scalar(both.to_i, [&](const T& v, int s)
                               HWY_ATTR { u[s] = hn::Add(u[s], widened<sum_real>(hn::IfThenElseZero(in, v.v))); });
    if constexpr (symmetric) {
      V to_j[S];
      each_scalar(both.to_j, [&](const T& v, int s) HWY_ATTR { to_j[s] = hn::IfThenElseZero(in, v.v); });
      add_to_rows<real>(t_.rates_of_row(0), tiles::rates_stride, hits, to_j);
    }
  }

  char apart_[2880];  // see nearby
  HWY_ALIGN std::uint32_t hits_[capacity];
  HWY_ALIGN stored_pairs ahead_[ahead > 0 ? ahead : 1];
  std::uint32_t ends_[most + 1];  ///< by particle: behind its last vector
  std::uint32_t particles_[most + 1];
  const tiles& t_;
  std::uint32_t spare_;
  std::size_t vectors_ = 0, n_ = 0;
};

}  // namespace pairsum

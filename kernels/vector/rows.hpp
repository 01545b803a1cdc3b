#pragma once
#include <cstdint>

#include <pairsum/formula/row_layout.hpp>
#include <pairsum/vector/lanes.hpp>

/// Converts between rows (the values of one particle, anywhere in memory) and vectors with one particle per lane. Rows
/// are loaded in blocks of a few values and transposed in registers, which takes a fraction of the time of gather and
/// scatter instructions. Rows are padded to whole blocks of row_block values.
namespace pairsum {

namespace rows_detail {

/// Values moved as one: four, or what a vector of this instruction set has.
template <class R>
inline constexpr std::size_t piece = lane_count<R> < row_block ? lane_count<R> : row_block;

/// Piece k of the vector: the piece at `from` of row index[k * piece].
template <class D, class R>
HWY_INLINE hn::Vec<D> load(D d, const R* from, std::size_t stride, const std::uint32_t* index) {
  constexpr std::size_t n = hn::MaxLanes(D());
  if constexpr (n == piece<R>) {
    return hn::LoadU(d, from + index[0] * stride);
#if HWY_CAP_GE512
  } else if constexpr (n == 4 * piece<R> && sizeof(R) == 4) {
    // Straight from memory to where a piece belongs; halves that are joined in registers take the unit that transposes.
    const auto at = [&](std::size_t k) HWY_ATTR { return _mm_loadu_ps(from + index[k * piece<R>] * stride); };
    __m512 v = _mm512_castps128_ps512(at(0));
    v = _mm512_mask_broadcast_f32x4(v, 0x00f0, at(1));
    v = _mm512_mask_broadcast_f32x4(v, 0x0f00, at(2));
    return hn::Vec<D>{_mm512_mask_broadcast_f32x4(v, 0xf000, at(3))};
#endif
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, load(half, from, stride, index + n / 2), load(half, from, stride, index));
  }
}

/// values += v, in the precision of the values.
template <class D, class R>
HWY_INLINE void add_piece(D d, hn::Vec<D> v, R* values) {
  constexpr std::size_t n = hn::MaxLanes(D());
  if constexpr (std::is_same_v<R, hn::TFromD<D>>) {
    hn::StoreU(hn::Add(hn::LoadU(d, values), v), d, values);
  } else if constexpr (n <= lane_count<R>) {
    const hn::Rebind<R, D> wide;
    hn::StoreU(hn::Add(hn::LoadU(wide, values), hn::PromoteTo(wide, v)), wide, values);
  } else {
    const hn::Half<D> half;
    add_piece(half, hn::LowerHalf(half, v), values);
    add_piece(half, hn::UpperHalf(half, v), values + n / 2);
  }
}

/// Adds piece k of v to the piece at `first` of row row_of(index[k * piece]) of R.
template <class R, class D, class RowOf>
HWY_INLINE void add(D d, hn::Vec<D> v, const RowOf& row_of, std::size_t first, const std::uint32_t* index) {
  constexpr std::size_t n = hn::MaxLanes(D());
  if constexpr (n == piece<hn::TFromD<D>>) {
    add_piece(d, v, row_of(index[0]) + first);
  } else if constexpr (!std::is_same_v<R, hn::TFromD<D>> && n <= lane_count<R>) {
    const hn::Rebind<R, D> wide;  // one conversion for several rows
    add<R>(wide, hn::PromoteTo(wide, v), row_of, first, index);
  } else {
    const hn::Half<D> half;
    add<R>(half, hn::LowerHalf(half, v), row_of, first, index);
    add<R>(half, hn::UpperHalf(half, v), row_of, first, index + n / 2);
  }
}

/// The sum of v's pieces.
template <class R, class D>
HWY_INLINE auto sum_of_pieces([[maybe_unused]] D d, hn::Vec<D> v) {
  if constexpr (hn::MaxLanes(D()) == piece<R>) {
    return v;
  } else {
    const hn::Half<D> half;
    return sum_of_pieces<R>(half, hn::Add(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
  }
}

/// The lower and the upper halves of the pieces (of four doubles) of a and b, in turns.
template <class V>
HWY_INLINE V lower_halves(V a, V b) {
  const hn::DFromV<V> d;
#if HWY_CAP_GE512
  if constexpr (sizeof(V) == 64) {
    alignas(64) static constexpr std::int64_t from[8] = {0, 1, 8, 9, 4, 5, 12, 13};
    return V{_mm512_permutex2var_pd(a.raw, _mm512_load_si512(from), b.raw)};
  } else
#endif
    return hn::ConcatLowerLower(d, b, a);
}
template <class V>
HWY_INLINE V upper_halves(V a, V b) {
  const hn::DFromV<V> d;
#if HWY_CAP_GE512
  if constexpr (sizeof(V) == 64) {
    alignas(64) static constexpr std::int64_t from[8] = {2, 3, 10, 11, 6, 7, 14, 15};
    return V{_mm512_permutex2var_pd(a.raw, _mm512_load_si512(from), b.raw)};
  } else
#endif
    return hn::ConcatUpperUpper(d, b, a);
}

/// Transposes inside pieces: value b of piece k of v[r] becomes value r of piece k of v[b]. Its own inverse.
template <class V>
HWY_INLINE void transpose(V (&v)[2]) {
  const hn::DFromV<V> d;
  const V low = hn::InterleaveLower(d, v[0], v[1]), high = hn::InterleaveUpper(d, v[0], v[1]);
  v[0] = low;
  v[1] = high;
}
template <class V>
HWY_INLINE void transpose(V (&v)[4]) {
  const hn::DFromV<V> d;
  const V a = hn::InterleaveLower(d, v[0], v[1]), b = hn::InterleaveLower(d, v[2], v[3]);
  const V e = hn::InterleaveUpper(d, v[0], v[1]), f = hn::InterleaveUpper(d, v[2], v[3]);
  if constexpr (sizeof(hn::TFromV<V>) == 4) {
    const hn::RepartitionToWide<decltype(d)> w;
    const auto wa = hn::BitCast(w, a), wb = hn::BitCast(w, b), we = hn::BitCast(w, e), wf = hn::BitCast(w, f);
    v[0] = hn::BitCast(d, hn::InterleaveLower(w, wa, wb));
    v[1] = hn::BitCast(d, hn::InterleaveUpper(w, wa, wb));
    v[2] = hn::BitCast(d, hn::InterleaveLower(w, we, wf));
    v[3] = hn::BitCast(d, hn::InterleaveUpper(w, we, wf));
  } else {
    v[0] = lower_halves(a, b);
    v[1] = lower_halves(e, f);
    v[2] = upper_halves(a, b);
    v[3] = upper_halves(e, f);
  }
}

/// load() of row r of each piece's and transpose(), for all rows of the lanes. Of eight doubles these two may choose
/// which rows share a vector: those of lanes l and l + 2 in place of l and l + 4, so that the second step of the
/// transposition needs no table and overwrites nothing.
template <class D, class R>
HWY_INLINE hn::Vec<D> load_for_lanes(D d, const R* from, std::size_t stride, const std::uint32_t* index,
                                     std::size_t r) {
#if HWY_CAP_GE512
  if constexpr (sizeof(R) == 8) {
    const std::uint32_t* const first = index + (r < 2 ? r : r + 2);
    const auto at = [&](std::size_t k) HWY_ATTR { return _mm256_loadu_pd(from + first[k] * stride); };
    return hn::Vec<D>{_mm512_insertf64x4(_mm512_castpd256_pd512(at(0)), at(2), 1)};
  }
#endif
  return load(d, from, stride, index + r);
}
template <class V, std::size_t P>
HWY_INLINE void transpose_for_lanes(V (&v)[P]) {
#if HWY_CAP_GE512
  if constexpr (sizeof(hn::TFromV<V>) == 8) {
    static_assert(P == 4);
    const hn::DFromV<V> d;
    const V a = hn::InterleaveLower(d, v[0], v[1]), b = hn::InterleaveLower(d, v[2], v[3]);
    const V e = hn::InterleaveUpper(d, v[0], v[1]), f = hn::InterleaveUpper(d, v[2], v[3]);
    v[0] = V{_mm512_shuffle_f64x2(a.raw, b.raw, 0x88)};
    v[1] = V{_mm512_shuffle_f64x2(e.raw, f.raw, 0x88)};
    v[2] = V{_mm512_shuffle_f64x2(a.raw, b.raw, 0xdd)};
    v[3] = V{_mm512_shuffle_f64x2(e.raw, f.raw, 0xdd)};
    return;
  }
#endif
  transpose(v);
}

}  // namespace rows_detail

/// values[k] becomes the vector of value k of the rows index[0 .. lanes). `stride`: distance of rows, at least
/// padded(n).
template <std::size_t n, class R>
HWY_INLINE void load_rows(const R* rows, std::size_t stride, const std::uint32_t* index, lane_vector<R> (&values)[n]) {
  constexpr std::size_t P = rows_detail::piece<R>, blocks = (n + P - 1) / P;
  // With 32 registers all blocks of a row are loaded while its address is at hand; with 16 that brought nothing.
  if constexpr (HWY_CAP_GE512) {
    lane_vector<R> v[blocks][P];
#pragma GCC unroll 16
    for (std::size_t r = 0; r < P; ++r)
#pragma GCC unroll 16
      for (std::size_t b = 0; b < blocks; ++b)
        v[b][r] = rows_detail::load_for_lanes(lane_tag<R>(), rows + b * P, stride, index, r);
#pragma GCC unroll 16
    for (auto& block : v) rows_detail::transpose_for_lanes(block);
#pragma GCC unroll 64
    for (std::size_t k = 0; k < n; ++k) values[k] = v[k / P][k % P];
  } else {
    for (std::size_t first = 0; first < n; first += P) {
      lane_vector<R> v[P];
      for (std::size_t r = 0; r < P; ++r) v[r] = rows_detail::load(lane_tag<R>(), rows + first, stride, index + r);
      rows_detail::transpose(v);
      for (std::size_t b = 0; b < P && first + b < n; ++b) values[first + b] = v[b];
    }
  }
}

/// Adds lane l of values[k] to value k of row_of(index[l]), one row after the other, so that a row may be there twice.
/// Rows may be of a type W wider than the lanes.
template <class R, class W, std::size_t n, class RowOf>
HWY_INLINE void add_to_rows(const RowOf& row_of, const std::uint32_t* index, const lane_vector<R> (&values)[n]) {
  constexpr std::size_t P = rows_detail::piece<R>;
  const lane_tag<R> d;
  for (std::size_t first = 0; first < n; first += P) {
    lane_vector<R> v[P];
    for (std::size_t b = 0; b < P; ++b) v[b] = first + b < n ? values[first + b] : hn::Zero(d);
    rows_detail::transpose(v);
    for (std::size_t r = 0; r < P; ++r) rows_detail::add<W>(d, v[r], row_of, first, index + r);
  }
}

/// v in lanes of R, which may be twice as wide as its own: then the sum of its halves.
template <class R, class V>
HWY_INLINE lane_vector<R> widened(V v) {
  if constexpr (std::is_same_v<R, hn::TFromV<V>>) {
    return v;
  } else {
    const lane_tag<R> wide;
    const hn::Half<hn::DFromV<V>> half;
    return hn::Add(hn::PromoteTo(wide, hn::LowerHalf(half, v)), hn::PromoteTo(wide, hn::UpperHalf(half, v)));
  }
}

/// Adds the sum over the lanes of values[k] to value k of a row.
template <std::size_t n, class R>
HWY_INLINE void add_sums_to_row(R* row, const lane_vector<R> (&values)[n]) {
  constexpr std::size_t P = rows_detail::piece<R>;
  const lane_tag<R> d;
  const hn::CappedTag<R, P> one;
  for (std::size_t first = 0; first < n; first += P) {
    lane_vector<R> v[P];
    for (std::size_t b = 0; b < P; ++b) v[b] = first + b < n ? values[first + b] : hn::Zero(d);
    rows_detail::transpose(v);
    for (std::size_t b = 1; b < P; ++b) v[0] = hn::Add(v[0], v[b]);
    hn::StoreU(hn::Add(hn::LoadU(one, row + first), rows_detail::sum_of_pieces<R>(d, v[0])), one, row + first);
  }
}

}  // namespace pairsum

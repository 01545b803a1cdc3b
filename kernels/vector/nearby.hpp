#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "sum/candidates.hpp"
#include "vector/lanes.hpp"

namespace pairsum {

/// Candidates around one place, copied together: positions relative to it, in float whatever the working precision, so
/// that a distance test takes twice the lanes of double. It tests |x_j|^2 - 2 x_i.x_j < reach^2 - |x_i|^2, one fused
/// multiply-add per component, and lets a little more pass than is in reach: whoever uses the hits decides in the
/// working precision.
template <int D, class V>
class alignas(4096) nearby {
  using tag = lane_tag<float>;
  static constexpr std::size_t N = lane_count<float>;

 public:
  static constexpr std::size_t capacity = 1104;

  /// Starts over, around `origin`, for a squared reach. Lengths are in units of the reach from here on, so that float
  /// holds them whatever the reach is.
  template <class R>
  void clear(const vec<D, R>& origin, R reach2) {
    for (int c = 0; c < D; ++c) origin_[c] = origin[c];
    inverse_ = 1 / std::sqrt(static_cast<double>(reach2));
    n_ = 0;
  }
  std::size_t size() const { return n_; }
  bool full() const { return n_ == capacity; }

  /// Is x near enough to the origin to be tested against the candidates? (Cells that fold together have particles
  /// that lie far apart.) If so, `place` is where.
  template <class R>
  bool has_near(const vec<D, R>& x, float (&place)[D]) const {
    bool in = true;
    for (int c = 0; c < D; ++c) {
      place[c] = static_cast<float>((x[c] - static_cast<R>(origin_[c])) * static_cast<R>(inverse_));
      in = in && std::abs(place[c]) < near;
    }
    return in;
  }

  /// Takes candidates from `range` until full; what is left stays in the range. `total`: length of the columns.
  template <class R>
  HWY_INLINE void take(const positions<D, R>& x, std::size_t total, index_range& range) {
    const tag d;
    const lane_tag<std::uint32_t> di;
    const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(range.end, range.begin + (capacity - n_)));
    auto index = hn::Iota(di, range.begin);
    std::size_t slot = n_;
    for (std::size_t j = range.begin; j < end; j += N, slot += N, index = hn::Add(index, hn::Set(di, N))) {
      auto square = hn::Zero(d);
      for (int c = 0; c < D; ++c) {
        const auto v = relative(x.column[c], j, total, static_cast<R>(origin_[c]), static_cast<R>(inverse_));
        hn::StoreU(v, d, x_[c] + slot);
        square = hn::MulAdd(v, v, square);
      }
      hn::StoreU(square, d, square_ + slot);
      hn::StoreU(index, di, index_ + slot);
    }
    n_ += end - range.begin;
    range.begin = end;
  }

  /// To be called when all were taken: nothing behind the last is in reach of anything.
  HWY_INLINE void close() {
    const tag d;
    hn::StoreU(hn::Set(d, std::numeric_limits<float>::quiet_NaN()), d, square_ + n_);
    for (int c = 0; c < D; ++c) hn::StoreU(hn::Zero(d), d, x_[c] + n_);
  }

  /// Writes the indices of the candidates in slots first .. last-1 that pass the test from `place`, in their order, to
  /// `hits`, which needs room for a vector more than there are; returns their end. What is behind the last slot is
  /// taken for a candidate unless `masked`, see close().
  template <bool masked>
  HWY_INLINE std::uint32_t* find(const float (&place)[D], std::size_t first, std::size_t last,
                                 std::uint32_t* hits) const {
    const tag d;
    const lane_tag<std::uint32_t> di;
    float own = 0;
    for (int c = 0; c < D; ++c) own += place[c] * place[c];
    const auto limit = hn::Set(d, widened - own);
    for (std::size_t k = first; k < last; k += N) {
      auto sum = hn::LoadU(d, square_ + k);
      for (int c = 0; c < D; ++c) sum = hn::NegMulAdd(hn::Set(d, 2 * place[c]), hn::LoadU(d, x_[c] + k), sum);
      auto in = hn::Lt(sum, limit);
      if constexpr (masked)
        if (k + N > last) in = hn::And(in, hn::FirstN(d, last - k));
      const auto mask = hn::RebindMask(di, in);
      hn::StoreU(hn::Compress(hn::LoadU(di, index_ + k), mask), di, hits);
      hits += hn::CountTrue(di, mask);
    }
    return hits;
  }

 private:
  /// How far from the origin a particle may be, per component, and the limit of the test. With u = 2^-24: |x_i|^2 <=
  /// 48, |x_j|^2 <= 63, the sum rounds up to seven times at most 111 u without fused operations, and the rounding of
  /// x_i and x_j themselves adds 40 u: less than 5e-5 in all.
  static constexpr float near = 4, widened = 1 + 5e-5f;

  /// (x[j ..) - origin) * scale; beyond `total` anything.
  static HWY_INLINE hn::Vec<tag> relative(const float* x, std::size_t j, std::size_t total, float origin, float scale) {
    return hn::Mul(hn::Sub(values(tag(), x, j, total), hn::Set(tag(), origin)), hn::Set(tag(), scale));
  }
  static HWY_INLINE hn::Vec<tag> relative(const double* x, std::size_t j, std::size_t total, double origin,
                                          double scale) {
    const lane_tag<double> d;
    const hn::Rebind<float, lane_tag<double>> half;
    const auto o = hn::Set(d, origin), s = hn::Set(d, scale);
    return hn::Combine(tag(), hn::DemoteTo(half, hn::Mul(hn::Sub(values(d, x, j + N / 2, total), o), s)),
                       hn::DemoteTo(half, hn::Mul(hn::Sub(values(d, x, j, total), o), s)));
  }
  template <class T, class R>
  static HWY_INLINE hn::Vec<T> values(T d, const R* x, std::size_t j, std::size_t total) {
    constexpr std::size_t n = hn::MaxLanes(T());
    if (j + n <= total) return hn::LoadU(d, x + j);
    HWY_ALIGN R last[n] = {};  // a masked load may read behind the end
    for (std::size_t l = 0; j + l < total; ++l) last[l] = x[j + l];
    return hn::Load(d, last);
  }

  // The columns of a cell with its neighbours (some 100 candidates) lie at different places of a page: a load whose
  // address differs from a recent store's by a multiple of 4096 waits for it.
  static constexpr std::size_t room = 1168;
  static_assert(room >= capacity + 2 * N);
  HWY_ALIGN float x_[D][room];
  HWY_ALIGN float square_[room];
  HWY_ALIGN std::uint32_t index_[room];
  double origin_[D], inverse_;
  std::size_t n_ = 0;
};

}  // namespace pairsum

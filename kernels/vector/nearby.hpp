#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <pairsum/sum/meeting.hpp>
#include <pairsum/sum/search_space.hpp>
#include <pairsum/vector/lanes.hpp>

namespace pairsum {

/// Candidates around one particle, copied together: their positions relative to it, in float for every working
/// precision, so that a distance test has twice the lanes of double. The test is |x_j|^2 - 2 x_i.x_j < reach^2 -
/// |x_i|^2, one fused multiply-add per component. It passes slightly more than the candidates within the cutoff; the
/// sum decides in the working precision. Positions are fixed-point numbers, called places (sum/search_space.hpp).
/// `ordered`: the numbers of places are not those of particles, see the constructor.
template <int D, class V, bool ordered>
class alignas(4096) nearby {
  using tag = lane_tag<float>;
  static constexpr std::size_t N = lane_count<float>;
  static_assert(2 * N <= place_room);

 public:
  using places = std::array<const std::int32_t*, static_cast<std::size_t>(D)>;
  static constexpr std::size_t capacity = 1104;

  /// `order`: which particle is number k; nullptr if not `ordered`: number k.
  explicit nearby(const std::uint32_t* order) : order_(order) {}

  /// Starts over, around particle i, for a reach in units of the problem's, at most 1, and places of which rounding
  /// moves the square of a distance by up to `excess`.
  void clear(const places& place, std::uint32_t i, float reach, float excess) {
    for (int c = 0; c < D; ++c) origin_[c] = place[c][i];
    limit_ = (reach * reach + rounding + excess) * unit * unit;
    n_ = 0;
  }
  /// The same in a periodic box, where a place takes place_size[c] units. Displacements are minimum images as seen from
  /// the origin, which holds for particles within half an edge of it.
  void clear(const places& place, std::uint32_t i, float reach, float excess, const std::array<float, D>& place_size,
             const std::array<float, D>& half_edge) {
    clear(place, i, reach, excess);
    sized_ = true;
    for (int c = 0; c < D; ++c) {
      size_of_place_[c] = place_size[c];
      most_[c] = std::min(near * unit, half_edge[c] - 1.01f * unit);
    }
  }
  std::size_t size() const { return n_; }
  bool full() const { return n_ == capacity; }

  /// Is particle i near enough to the origin to be tested against the candidates? (Cells that fold together have
  /// particles that lie far apart.) If so, `at` is where.
  bool has_near(const places& place, std::uint32_t i, float (&at)[D]) const {
    bool in = true;
    for (int c = 0; c < D; ++c) {
      const std::uint32_t from_origin =
          static_cast<std::uint32_t>(place[c][i]) - static_cast<std::uint32_t>(origin_[c]);
      at[c] = static_cast<float>(static_cast<std::int32_t>(from_origin));
      if (sized_) at[c] *= size_of_place_[c];
      in = in && std::abs(at[c]) < (sized_ ? most_[c] : near * unit);
    }
    return in;
  }

  /// Takes candidates from `range` until full; the rest stays in the range.
  HWY_INLINE void take(const places& place, index_range& range) {
    const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(range.end, range.begin + (capacity - n_)));
    std::size_t j = range.begin, slot = n_;
    // Cells in a row hold some two vectors of candidates: these are copied without testing how many there are.
    copy(place, j, slot);
    copy(place, j + N, slot + N);
    for (j += 2 * N, slot += 2 * N; j < end; j += N, slot += N) copy(place, j, slot);
    n_ += end - range.begin;
    range.begin = end;
  }

  /// To be called when all were taken: nothing behind the last is within any cutoff.
  HWY_INLINE void close() {
    const tag d;
    hn::StoreU(hn::Set(d, std::numeric_limits<float>::quiet_NaN()), d, square_ + n_);
    for (int c = 0; c < D; ++c) hn::StoreU(hn::Zero(d), d, x_[c] + n_);
  }

  /// Writes the indices of the candidates that pass the test from `place`, in their order, to `hits`, which needs room
  /// for a vector more than there are; returns their end.
  HWY_INLINE std::uint32_t* find(const float (&place)[D], std::uint32_t* hits) const {
    return find_from(0, test(*this, place), hits);
  }
  /// Of those behind slot `own`. It starts with whole vectors, so that loads do not straddle cache lines and the number
  /// of vectors is the same for most particles of a cell.
  HWY_INLINE std::uint32_t* find_after(const float (&place)[D], std::size_t own, std::uint32_t* hits) const {
    const tag d;
    if (own >= n_) return hits;
    const test in(*this, place);
    const std::size_t at = own / N * N;
    hits = keep(at, hn::AndNot(hn::FirstN(d, own - at + 1), in(at)), hits);
    return find_from(at + N, in, hits);
  }
  /// Of all but the one in slot `own`.
  HWY_INLINE std::uint32_t* find_but(const float (&place)[D], std::size_t own, std::uint32_t* hits) const {
    const tag d;
    const test in(*this, place);
    if (own >= n_) return find_from(0, in, hits);
    const std::size_t at = own / N * N;
    for (std::size_t k = 0; k < at; k += N) hits = keep(k, in(k), hits);
    const auto others = hn::Or(hn::FirstN(d, own - at), hn::Not(hn::FirstN(d, own - at + 1)));
    hits = keep(at, hn::And(others, in(at)), hits);
    return find_from(at + N, in, hits);
  }

 private:
  /// Which candidates in slots k .. k + N - 1 pass the test from a place? None of those behind the last, see close().
  class test {
   public:
    HWY_INLINE test(const nearby& near, const float (&place)[D]) : near_(near) {
      float norm = 0;
      for (int c = 0; c < D; ++c) {
        norm += place[c] * place[c];
        twice_[c] = hn::Set(tag(), 2 * place[c]);
      }
      limit_ = hn::Set(tag(), near.limit_ - norm);
    }
    HWY_INLINE auto operator()(std::size_t k) const {
      auto sum = hn::Load(tag(), near_.square_ + k);
      for (int c = 0; c < D; ++c) sum = hn::NegMulAdd(twice_[c], hn::Load(tag(), near_.x_[c] + k), sum);
      return hn::Lt(sum, limit_);
    }

   private:
    const nearby& near_;
    hn::Vec<tag> twice_[D], limit_;
  };

  HWY_INLINE std::uint32_t* find_from(std::size_t k, const test& in, std::uint32_t* hits) const {
    for (; k < n_; k += N) hits = keep(k, in(k), hits);
    return hits;
  }
  template <class Mask>
  HWY_INLINE std::uint32_t* keep(std::size_t k, Mask in, std::uint32_t* hits) const {
    const lane_tag<std::uint32_t> di;
    const auto mask = hn::RebindMask(di, in);
    hn::StoreU(hn::Compress(hn::Load(di, index_ + k), mask), di, hits);
    return hits + hn::CountTrue(di, mask);
  }

  /// One vector of candidates, those beyond the range among them: they are overwritten by the next, or never tested.
  HWY_INLINE void copy(const places& place, std::size_t j, std::size_t slot) {
    const tag d;
    const lane_tag<std::int32_t> di;
    const lane_tag<std::uint32_t> du;
    auto square = hn::Zero(d);
    for (int c = 0; c < D; ++c) {
      auto x = hn::ConvertTo(d, hn::Sub(hn::LoadU(di, place[c] + j), hn::Set(di, origin_[c])));
      if (sized_) x = hn::Mul(x, hn::Set(d, size_of_place_[c]));
      hn::StoreU(x, d, x_[c] + slot);
      square = hn::MulAdd(x, x, square);
    }
    hn::StoreU(square, d, square_ + slot);
    if constexpr (ordered)
      hn::StoreU(hn::LoadU(du, order_ + j), du, index_ + slot);
    else
      hn::StoreU(numbered_from(du, j), du, index_ + slot);
  }

  /// How far from the origin a particle may be, per component, in units of the cutoff. Its partners are then less than
  /// 5 cutoffs from the origin, less than 2^23 places, which float holds exactly.
  static constexpr float near = 4, unit = places_per_reach;
  /// How much the limit exceeds the square of the cutoff, in its units, for rounding in the test. With u = 2^-24:
  /// |x_i|^2 <= 48, |x_j|^2 <= 63; without fused operations the sum rounds up to seven times at most 111 u (4.7e-5),
  /// the limit and the test in the working precision, which decides, a few times 49 u at most.
  static constexpr float rounding = 7e-5f;

  // The columns of a cell with its neighbours (some 100 candidates) lie at different places of a page: a load whose
  // address differs from a recent store's by a multiple of 4096 waits for it.
  static constexpr std::size_t room = 1168;
  static_assert(room >= capacity + 3 * N);
  HWY_ALIGN float x_[D][room];
  HWY_ALIGN float square_[room];
  HWY_ALIGN std::uint32_t index_[room];
  const std::uint32_t* order_;
  std::int32_t origin_[D];
  bool sized_ = false;  ///< in a periodic box
  float size_of_place_[D], most_[D];
  float limit_ = 0;
  std::size_t n_ = 0;
};

}  // namespace pairsum

#pragma once
#include <limits>

#include <pairsum/formula/formula_view.hpp>
#include <pairsum/formula/row_layout.hpp>
#include <pairsum/vector/lane_lister.hpp>
#include <pairsum/vector/near_ties.hpp>
#include <pairsum/vector/rows.hpp>

namespace pairsum {

/// The sum of listed rows on vector units, for one instruction set (that of V):
///
///   for rows i, for vectors of its partners j:
///     load, transpose, r, r2, |r|
///     formula, 0 in lanes beyond the cutoff; u_i += to_i      u_i in registers, summed over the lanes behind the last
///     vector u_j += to_j                                        row by row
///
/// A core's scheduler holds fewer waiting instructions than two vectors of pairs have, so the loads of the next vector
/// cannot begin early. Where both sides are updated and lanes have four bytes, half of the instructions are loads and
/// transposition. There these run a few vectors ahead in a separate loop. Elsewhere storing and reloading their results
/// costs more than it gains.
template <class I, class V>
class lane_rows_sum {
  using layout = row_layout<I>;
  using value = typename layout::value;
  using real = typename layout::real;
  using T = lanes<V>;
  using W = lane_vector<real>;
  static constexpr int D = I::dim;
  static constexpr std::size_t N = lane_count<value>, K = layout::values, S = layout::rates;
  using particle = typename I::template particle<T>;
  using P = problem<D, real>;

 public:
  static void both(const void* call, const row* rows, std::size_t n) { sum<true, rates_in_rows>(call, rows, n); }
  static void own(const void* call, const row* rows, std::size_t n) { sum<false, rates_in_columns>(call, rows, n); }

  /// Finding and summing in one function, for sweeps over blocks of cells: an indirect call per cell costs 2 to 8 % of
  /// their time.
  static void half_stencils(const sum_call<D, real>& c, const std::uint32_t* cell, std::size_t n) {
    of_cells<partners::later, &both>(c, cell, n);
  }
  static void full_stencils(const sum_call<D, real>& c, const std::uint32_t* cell, std::size_t n) {
    of_cells<partners::others, &own>(c, cell, n);
  }

 private:
  static constexpr std::size_t ahead = sizeof(value) == 4 ? 4 : 0;

  /// Rates of the rows themselves, and not of a copy.
  struct rates_in_own_rows {
    std::byte* begin;
    explicit rates_in_own_rows(const sum_call<D, real>& c) : begin(static_cast<std::byte*>(c.to.u.begin[0])) {}
    HWY_INLINE real* operator()(std::size_t i) const { return reinterpret_cast<real*>(begin + i * layout::bytes); }
    HWY_INLINE void add_sums(std::size_t i, const W (&u)[S]) const { add_sums_to_row((*this)(i), u); }
  };
  /// Rates of the rows or of a copy, or, where a block of particles has a buffer, of that.
  struct rates_in_rows {
    std::byte *begin, *buffer = nullptr;
    std::size_t stride, buffer_stride = 0;
    const std::uint32_t* slot;
    explicit rates_in_rows(const sum_call<D, real>& c)
        : begin(static_cast<std::byte*>(c.to.u.begin[0])), stride(c.to.u.stride), slot(c.to.slot) {
      if (slot == nullptr) return;
      buffer = static_cast<std::byte*>(c.to.buffer.begin[0]);
      buffer_stride = c.to.buffer.stride;
    }
    HWY_INLINE real* operator()(std::size_t i) const {
      if (slot != nullptr) [[unlikely]]
        if (const std::size_t at = slot[i / split_block]; at != unsplit)
          return reinterpret_cast<real*>(buffer + (at * split_block + i % split_block) * buffer_stride);
      return reinterpret_cast<real*>(begin + i * stride);
    }
    HWY_INLINE void add_sums(std::size_t i, const W (&u)[S]) const { add_sums_to_row((*this)(i), u); }
  };
  struct rates_in_columns {
    void* const* begin;
    explicit rates_in_columns(const sum_call<D, real>& c) : begin(c.p.columns.begin) {}
    HWY_INLINE void add_sums(std::size_t i, const W (&u)[S]) const {
      HWY_ALIGN real sums[padded(S)] = {};
      add_sums_to_row(sums, u);
      for (std::size_t s = 0; s < S; ++s) static_cast<real*>(begin[s])[i] += sums[s];
    }
  };

  /// A vector of pairs: r = x_i - x_j, r.r, |r|, and the data of j.
  struct pairs {
    vec<D, T> r;
    T r2, distance;
    particle other;
  };
  using stored_pairs = value[K + 2][N];

  explicit HWY_INLINE lane_rows_sum(const P& p)
      : p_(p),
        lane_(*p.lane),
        formula_(*formula_view<I>::of(p).formula),
        rows_(reinterpret_cast<const value*>(lane_.rows)) {}

  template <bool symmetric>
  struct summed_here {
    static constexpr bool has_boundary = pairsum::has_boundary<I>;
    static HWY_INLINE void sum(const row_sink& sink, const row* rows, std::size_t n) {
      lane_rows_sum::sum<symmetric, std::conditional_t<symmetric, rates_in_own_rows, rates_in_columns>>(sink.call, rows,
                                                                                                        n);
    }
  };
  template <partners who, rows_function take>
  static HWY_INLINE void of_cells(const sum_call<D, real>& c, const std::uint32_t* cell, std::size_t n) {
    const row_sink sink{take, &c, c.p.spare_of(c.to.thread)};
    using lister = lane_lister<D, lane_vector<float>, summed_here<who == partners::later>>;
    lister::template list_cells<who, layout::bytes>(c.p.places, c.p.cells(), c.p.lane->rows, sink, cell, n);
  }

  template <bool symmetric, class To>
  static HWY_INLINE void sum(const void* call, const row* rows, std::size_t n) {
    const auto& c = *static_cast<const sum_call<D, real>*>(call);
    const lane_rows_sum self(c.p);
    const To to(c);
    constexpr bool loads_ahead = symmetric && ahead > 0;
    HWY_ALIGN stored_pairs stored[loads_ahead ? ahead : 1];
    std::size_t v = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const row r = rows[k];
      W u[S];
      for (W& of_rate : u) of_rate = hn::Zero(lane_tag<real>());
      const value* const own = self.row_of(r.i);
      const auto one = self.particle_at(own);
      for (std::size_t at = 0; at < r.fluid_count; at += N) {
        const std::uint32_t* const hits = r.fluid + at;
        if constexpr (loads_ahead) {
          if (v % ahead == 0) self.load_ahead(rows, n, k, at, stored);
          self.template sum_vector<symmetric>(restored(stored[v % ahead]), hits, r.i, one, u, to);
          ++v;
        } else {
          self.template sum_vector<symmetric>(self.loaded(hits, own), hits, r.i, one, u, to);
        }
      }
      if constexpr (has_boundary<I>)
        if (r.boundary_count > 0) [[unlikely]]
          self.add_boundary(r, u);
      to.add_sums(r.i, u);
    }
  }

  HWY_INLINE const value* row_of(std::size_t i) const { return rows_ + i * layout::stride; }
  /// The data of a row's particle, in every lane.
  static HWY_INLINE particle particle_at(const value* row) { return particle_of_row<T>(row); }
  template <class L>
  static HWY_INLINE typename I::template particle<L> particle_of_row(const value* row) {
    typename I::template particle<L> a;
    each_scalar(a, [&](L& v, int k) HWY_ATTR { v = L(row[D + k]); });
    return a;
  }

  HWY_INLINE pairs loaded(const std::uint32_t* hits, const value* row) const {
    const lane_tag<value> d;
    V values[K];
    load_rows(rows_, layout::stride, hits, values);
    pairs p;
    if constexpr (is_mixed<I>) {
      const hn::RebindToSigned<lane_tag<value>> whole;
      for (int c = 0; c < D; ++c) {
        const auto from = hn::BitCast(whole, values[c]);
        const auto apart = hn::Sub(hn::BitCast(whole, hn::Set(d, row[c])), from);
        p.r[c] = hn::Mul(hn::ConvertTo(d, apart), hn::Set(d, static_cast<value>(lane_.mixed_unit[c])));
      }
      const auto there = hn::BitCast(whole, hn::LoadU(lane_tag<std::uint32_t>(), hits));
      const auto is = hn::Lt(there, hn::Set(whole, static_cast<std::int32_t>(p_.fluid_count)));
      p.r2 =
          hn::IfThenElse(hn::RebindMask(d, is), norm2<D, T>(p.r).v, hn::Set(d, std::numeric_limits<value>::infinity()));
    } else {
      for (int c = 0; c < D; ++c) p.r[c] = T(hn::Set(d, row[c])) - T(values[c]);
      if (lane_.periodic) [[unlikely]]
        for (int c = 0; c < D; ++c) p.r[c] = shortest_lanes(p.r[c].v, p_.x.omega.edge[c]);
      p.r2 = norm2<D, T>(p.r);
    }
    p.distance = square_root(p.r2);
    each_scalar(p.other, [&](T& v, int k) HWY_ATTR { v = values[D + k]; });
    return p;
  }

  /// Loads vectors from number `at` of the partners of row k on.
  HWY_INLINE void load_ahead(const row* rows, std::size_t n, std::size_t k, std::size_t at,
                             stored_pairs* stored) const {
    const lane_tag<value> d;
    for (std::size_t v = 0; v < ahead; ++v, at += N) {
      while (at >= rows[k].fluid_count) {
        if (++k == n) return;
        at = 0;
      }
      const pairs p = loaded(rows[k].fluid + at, row_of(rows[k].i));
      stored_pairs& to = stored[v];
      for (int c = 0; c < D; ++c) hn::Store(p.r[c].v, d, to[c]);
      each_scalar(p.other, [&](const T& a, int s) HWY_ATTR { hn::Store(a.v, d, to[D + s]); });
      hn::Store(p.r2.v, d, to[K]);
      hn::Store(p.distance.v, d, to[K + 1]);
    }
  }
  static HWY_INLINE pairs restored(const stored_pairs& from) {
    const lane_tag<value> d;
    pairs p;
    for (int c = 0; c < D; ++c) p.r[c] = hn::Load(d, from[c]);
    each_scalar(p.other, [&](T& a, int s) HWY_ATTR { a = hn::Load(d, from[D + s]); });
    p.r2 = hn::Load(d, from[K]);
    p.distance = hn::Load(d, from[K + 1]);
    return p;
  }

  /// u: sums of particle i so far.
  template <bool symmetric, class To>
  HWY_INLINE void sum_vector(const pairs& p, const std::uint32_t* hits, std::uint32_t i, const particle& one, W (&u)[S],
                             const To& to) const {
    const lane_tag<value> d;
    auto in = hn::Lt(p.r2.v, hn::Set(d, static_cast<value>(p_.reach2)));
    if (lane_.in_reach != nullptr) in = decide_near_ties(p_, in, p.r2.v, p_.reach2, i, hits);
    const auto c = pair_at<I, D, T>(formula_, p.distance, p.r, p.r2, one, p.other);
    each_scalar(c.to_i,
                [&](const T& v, int s) HWY_ATTR { u[s] = hn::Add(u[s], widened<real>(hn::IfThenElseZero(in, v.v))); });
    if constexpr (symmetric) {
      V to_j[S];
      each_scalar(c.to_j, [&](const T& v, int s) HWY_ATTR { to_j[s] = hn::IfThenElseZero(in, v.v); });
      add_to_rows<value, real>(to, hits, to_j);
    }
  }

  /// u += contributions of a row's boundary particles to its own. These pairs are few, so their particles are gathered
  /// from their columns, and always summed in I's own precision.
  HWY_INLINE void add_boundary(const row& of, W (&u)[S]) const {
    using L = lanes<W>;
    using whole = hwy::MakeSigned<real>;
    constexpr std::size_t M = lane_count<real>;
    const lane_tag<real> d;
    const hn::RebindToSigned<lane_tag<real>> di;
    const hn::Rebind<std::uint32_t, lane_tag<real>> dn;
    const auto& boundary = formula_view<I>::of(p_).boundary;
    const value* const row = row_of(of.i);
    const auto one = particle_of_row<L>(row);
    for (std::size_t k = 0; k < of.boundary_count; k += M) {
      const std::uint32_t* const b = of.boundary + k;
      const std::size_t left = of.boundary_count - k;
      // Lanes behind the last hit hold the first one, moved beyond the cutoff.
      const auto hit = hn::IfThenElse(hn::FirstN(dn, left), hn::LoadU(dn, b), hn::Set(dn, b[0]));
      const auto place = as_lanes(di, hit);
      const auto from = hn::Sub(place, hn::Set(di, static_cast<whole>(p_.fluid_count)));
      vec<D, L> r;
      for (int c = 0; c < D; ++c) {
        const real x_i = is_mixed<I> ? p_.x.column[c][of.i] : static_cast<real>(row[c]);
        r[c] = L(x_i) - L(hn::GatherIndex(d, p_.x.column[c], place));
        if (lane_.periodic) [[unlikely]]
          r[c] = shortest_lanes(r[c].v, p_.x.omega.edge[c]);
      }
      typename I::template boundary_particle<L> wall;
      each_scalar(wall,
                  [&](L& v, int s) HWY_ATTR { v = L(hn::GatherIndex(d, boundary.template column_as<real>(s), from)); });
      const L r2 = norm2<D, L>(r);
      auto in = hn::Lt(r2.v, hn::Set(d, p_.boundary_reach2));
      if (lane_.in_reach != nullptr) {
        std::uint32_t other[M];
        hn::StoreU(hit, dn, other);
        in = decide_near_ties(p_, in, r2.v, p_.boundary_reach2, of.i, other);
      }
      if (left < M) in = hn::And(in, hn::FirstN(d, left));
      const auto rates = formula_.boundary(r, r2, one, wall);
      each_scalar(rates, [&](const L& v, int s) HWY_ATTR { u[s] = hn::Add(u[s], hn::IfThenElseZero(in, v.v)); });
    }
  }

  const P& p_;
  const lane_view<D, real>& lane_;
  const I& formula_;
  const value* rows_;
};

}  // namespace pairsum

#pragma once
#include <algorithm>
#include <atomic>

#include <pairsum/core/same_code.hpp>
#include <pairsum/formula/formula_view.hpp>

/// The only loop over pairs that knows a formula, and the functions that sum/pair_sum.hpp points to.
namespace pairsum {

namespace rows_detail {

template <class S>
[[gnu::always_inline]] inline field_pointers<S> columns_of(const rate_view& u) {
  field_pointers<S> columns;
  std::copy_n(u.begin, field_count<S>, columns.begin.begin());
  return columns;
}

/// Where contributions go: add(i, rates) for both sides, `own` for the particle whose row it is.
template <class S>
struct to_columns {
  field_pointers<S> u;
  explicit to_columns(const target& t) : u(columns_of<S>(t.u)) {}
  [[gnu::always_inline]] void add(std::size_t i, const S& a) const { u.add(i, a); }
};
template <class S>
struct to_columns_atomically {
  field_pointers<S> u;
  explicit to_columns_atomically(const target& t) : u(columns_of<S>(t.u)) {}
  [[gnu::always_inline]] void add(std::size_t i, const S& s) const {
    each_scalar(
        s, [&](const auto& a, int slot) __attribute__((always_inline)) {
          using scalar = std::remove_cvref_t<decltype(a)>;
          std::atomic_ref(u.template column_as<scalar>(slot)[i]).fetch_add(a, std::memory_order_relaxed);
        });
  }
};
template <class S>
struct to_split_columns {
  field_pointers<S> u, buffer;
  const std::uint32_t* slot;
  explicit to_split_columns(const target& t) : u(columns_of<S>(t.u)), buffer(columns_of<S>(t.buffer)), slot(t.slot) {}
  [[gnu::always_inline]] void add(std::size_t i, const S& a) const {
    const std::size_t at = slot[i / split_block];
    if (at == unsplit)
      u.add(i, a);
    else
      buffer.add(at * split_block + i % split_block, a);
  }
};

}  // namespace rows_detail

/// The functions of interaction I on columns.
template <class I>
struct sum_rows {
  static constexpr int D = I::dim;
  using R = typename I::real;
  using P = problem<D, R>;
  using S = rates_of<I>;

  /// u_i = sum of a row; each(j, contribution to j) for its fluid pairs.
  template <class Each>
  [[gnu::always_inline]] static S sum_row(const P& p, const formula_view<I>& f, const row& r, Each&& each) {
    const auto a = f.fluid.load(r.i);
    auto u_i = zero<S>();
    either_side(
        p.x.point_of(r.i), [&](const auto& x_i) __attribute__((always_inline)) {
          for (const std::uint32_t *k = r.fluid, *end = k + r.fluid_count; k != end; ++k) {
            const vec<D, R> d = x_i - p.x[*k];
            const auto c = f.formula->pair(d, norm2<D, R>(d), a, f.fluid.load(*k));
            add(u_i, c.to_i);
            each(*k, c.to_j);
          }
          if constexpr (has_boundary<I>)
            for (const std::uint32_t *k = r.boundary, *end = k + r.boundary_count; k != end; ++k) {
              const vec<D, R> d = x_i - p.x[*k];
              add(u_i, f.formula->boundary(d, norm2<D, R>(d), a, f.boundary.load(*k - p.fluid_count)));
            }
        });
    return u_i;
  }

  template <template <class> class To>
  PAIRSUM_SAME_CODE static void both(const void* call, const row* rows, std::size_t n) {
    const auto& c = *static_cast<const sum_call<D, R>*>(call);
    const formula_view<I> f = formula_view<I>::of(c.p);
    const To<S> to(c.to);
    for (const row* r = rows; r != rows + n; ++r)
      to.add(r->i, sum_row(
                       c.p, f, *r, [&](std::uint32_t j, const S& a) __attribute__((always_inline)) { to.add(j, a); }));
  }
  PAIRSUM_SAME_CODE static void own(const void* call, const row* rows, std::size_t n) {
    const auto& c = *static_cast<const sum_call<D, R>*>(call);
    const formula_view<I> f = formula_view<I>::of(c.p);
    const auto u = rows_detail::columns_of<S>(c.to.u);
    for (const row* r = rows; r != rows + n; ++r)
      u.store(r->i, sum_row(c.p, f, *r, [](std::uint32_t, const S&) __attribute__((always_inline)){}));
  }

  /// The first and last of a cell's fluid: its columns are a cache line or two each. (Not inlined: g++
  /// takes a function that does nothing else for one without effect and drops its calls.)
  template <bool with_rates>
  [[gnu::always_inline]] static void fetch_cells(const P& p, const std::uint32_t* cell, unsigned n,
                                                 const rate_view* rates) {
    const formula_view<I>& f = formula_view<I>::of(p);
    for (unsigned k = 0; k < n; ++k) {
      const cell_range& range = p.cells().range[cell[k]];
      if (range.fluid.size() == 0) continue;
      const auto ends_of = [&](const void* column, std::size_t size) __attribute__((always_inline)) {
        const auto* const bytes = static_cast<const std::byte*>(column);
        __builtin_prefetch(bytes + range.fluid.begin * size);
        __builtin_prefetch(bytes + (range.fluid.end - 1) * size);
      };
      for (const auto* const column : p.x.column) ends_of(column, sizeof *column);
      each_scalar(
          zero<particle_of<I>>(), [&](const auto& a, int slot)
                                      __attribute__((always_inline)) { ends_of(f.fluid.begin[slot], sizeof a); });
      if constexpr (with_rates)
        each_scalar(
            zero<S>(), [&](const auto& a, int slot)
                           __attribute__((always_inline)) { ends_of(rates->begin[slot], sizeof a); });
    }
  }
  PAIRSUM_SAME_CODE static void fetch(const P& p, const std::uint32_t* cell, unsigned n, const rate_view* rates) {
    if (rates != nullptr)
      fetch_cells<true>(p, cell, n, rates);
    else
      fetch_cells<false>(p, cell, n, rates);
  }

  static void zero_rates(const rate_view& u, std::size_t begin, std::size_t end) {
    each_scalar(zero<S>(), [&](const auto& a, int slot) {
      auto* const column = static_cast<std::remove_cvref_t<decltype(a)>*>(u.begin[slot]);
      std::fill(column + begin, column + end, std::remove_cvref_t<decltype(a)>(0));
    });
  }
  static void add_rates(const rate_view& to, std::size_t to_at, const rate_view& from, std::size_t from_at,
                        std::size_t n) {
    each_scalar(zero<S>(), [&](const auto& a, int slot) {
      using scalar = std::remove_cvref_t<decltype(a)>;
      scalar* const u = static_cast<scalar*>(to.begin[slot]) + to_at;
      const scalar* const more = static_cast<const scalar*>(from.begin[slot]) + from_at;
      for (std::size_t k = 0; k < n; ++k) u[k] += more[k];
    });
  }
};

}  // namespace pairsum

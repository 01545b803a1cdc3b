#pragma once
#include <cstdint>
#include <vector>

#include <pairsum/core/same_code.hpp>
#include <pairsum/formula/row_layout.hpp>
#include <pairsum/sum/formula.hpp>

namespace pairsum {

/// Interaction I on the vector units that this machine runs, best first. The library's interactions have them for
/// every set that was built, compiled separately (formula/formulas.hpp). A user's own interaction has them for the set
/// that its source is compiled for (vector/own_lanes.hpp).
template <class I>
std::vector<lane_sum<I::dim, typename I::real>> lanes_of();

/// What vector units need besides: functions on rates in rows. This code needs no instruction set.
template <class I>
struct row_rates {
  static constexpr int D = I::dim;
  using R = typename I::real;
  static constexpr std::uint16_t bytes[] = {padded(field_count<rates_of<I>>) * sizeof(R)};

  static R* at(const rate_view& u, std::size_t i) {
    return reinterpret_cast<R*>(static_cast<std::byte*>(u.begin[0]) + i * u.stride);
  }
  static void zero(const rate_view& u, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) std::fill_n(at(u, i), padded(field_count<rates_of<I>>), R(0));
  }
  static void add(const rate_view& to, std::size_t to_at, const rate_view& from, std::size_t from_at, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      R* const u = at(to, to_at + k);
      const R* const more = at(from, from_at + k);
      for (int s = 0; s < field_count<rates_of<I>>; ++s) u[s] += more[s];
    }
  }
  static void to_columns(const rate_view& rows, const rate_view& columns, std::size_t begin, std::size_t end) {
    std::array<R*, field_count<rates_of<I>>> to;
    for (std::size_t s = 0; s < to.size(); ++s) to[s] = static_cast<R*>(columns.begin[s]);
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t s = 0; s < to.size(); ++s) to[s][i] = at(rows, i)[s];
  }
  /// All cache lines of the rows, since hits decide which are read. Rows may straddle lines (mixed ones do).
  PAIRSUM_SAME_CODE static void fetch(const problem<D, R>& p, const std::uint32_t* cell, unsigned n,
                                      const rate_view* rates) {
    constexpr std::size_t line = 64;
    const bool apart = rates != nullptr && rates->begin != p.u.begin;  // not in the rows
    for (unsigned k = 0; k < n; ++k) {
      const cell_range& range = p.cells().range[cell[k]];
      if (range.fluid.size() == 0) continue;
      const auto lines_of = [&](const std::byte* from, std::size_t stride) {
        const std::size_t end = range.fluid.end * stride;
        for (std::size_t at = range.fluid.begin * stride / line * line; at < end; at += line)
          __builtin_prefetch(from + at);
      };
      lines_of(p.lane->rows, row_layout<I>::bytes);
      if (apart) lines_of(static_cast<const std::byte*>(rates->begin[0]), rates->stride);
      for (const std::int32_t* const place : p.places.place) __builtin_prefetch(place + range.fluid.end - 1);
    }
  }

  /// A lane_sum whose sums alone are there, complete.
  static lane_sum<D, R> completed(lane_sum<D, R> sum) {
    sum.pairs.zero = &zero;
    sum.pairs.add = &add;
    sum.pairs.fetch = &fetch;
    sum.pairs.rate_bytes = bytes;
    sum.to_columns = &to_columns;
    return sum;
  }
};

}  // namespace pairsum

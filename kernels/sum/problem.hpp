#pragma once
#include <pairsum/core/places.hpp>
#include <pairsum/grid/cells.hpp>
#include <pairsum/sum/meeting.hpp>
#include <pairsum/sum/pair_sum.hpp>
#include <pairsum/sum/search_space.hpp>

namespace pairsum {

template <int D>
struct vector_lister;
template <int D, class R>
struct lane_view;

/// Everything a schedule sees of one summation: sorted particles, the cells they lie in, where the rates go, and the
/// formula behind pointers. Indices are positions in the sorted set: fluid [0, fluid_count), boundary behind it.
/// Nothing here is owned.
template <int D, class R>
struct problem : search_space<D, R> {
  const pairsum::cells<D>* grid_cells = nullptr;
  std::size_t fluid_count = 0, count = 0;  ///< fluid, and with the boundary
  rate_view u;                             ///< rates of the fluid, what is summed into
  rate_view columns;     ///< their columns; on vector units a gather adds to these and other sums to rows
  bool is_zero = false;  ///< u is 0 already
  const pair_sum<D, R>* pairs = nullptr;
  const void* formula = nullptr;            ///< opened by formula/ and vector/ alone
  const lane_view<D, R>* lane = nullptr;    ///< of vector units: the fluid as rows
  const vector_lister<D>* lanes = nullptr;  ///< lists rows on vector units; nullptr: scalar
  std::size_t spare_rows = 0;               ///< of vector units: rows behind the fluid, per thread
  int threads = 1;                          ///< of the team that prepared
  work_counts* counts = nullptr;            ///< nullptr when timed

  const pairsum::cells<D>& cells() const { return *grid_cells; }
  target to(int thread) const { return {.u = u, .thread = thread}; }
  /// Rates that a copy of them has: the fluid's, and the spare rows'.
  std::size_t rate_rows() const { return fluid_count + spare_rows * static_cast<std::size_t>(threads); }
  std::uint32_t spare_of(int thread) const {
    return static_cast<std::uint32_t>(fluid_count + spare_rows * static_cast<std::size_t>(thread));
  }
};

/// Lists the pairs of meetings in `space`, on vector units if the problem has them, and hands the rows to the sink.
template <int D, class R>
void list_meetings(const problem<D, R>& p, const search_space<D, R>& space, const row_sink& sink, const meeting<D>* m,
                   unsigned n, work_counts* counts);

/// Sums the pairs of meetings: both sides of each (partners all and later), or the own side (others).
template <int D, class R>
void sum_meetings(const problem<D, R>& p, const search_space<D, R>& space, const target& to, const meeting<D>* m,
                  unsigned n);
template <int D, class R>
inline void sum_meetings(const problem<D, R>& p, const target& to, const meeting<D>& m) {
  sum_meetings<D, R>(p, p, to, &m, 1);
}

/// Sums cell[0..n), one after the other: half stencils (partners later), or full ones (others).
template <int D, class R>
void sum_cells(const problem<D, R>& p, const target& to, partners who, const std::uint32_t* cell, std::size_t n);

/// Sums both sides of listed pairs; `tested`: only of those within the cutoff, from a list that holds more.
template <int D, class R>
void sum_listed(const problem<D, R>& p, const target& to, const row* rows, std::size_t n, bool tested);

}  // namespace pairsum

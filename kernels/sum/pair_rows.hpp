#pragma once
#include <algorithm>
#include <vector>

#include "core/same_code.hpp"
#include "core/team.hpp"
#include "sum/half_stencil.hpp"

namespace pairsum {

/// Room for lists of unknown length that stay where they are: chunks, reused from one filling to the next.
class list_pool {
 public:
  void restart() { chunk_ = used_ = 0; }
  /// Where the next `n` entries can be written.
  std::uint32_t* room_for(std::size_t n) {
    while (chunk_ < chunks_.size() && chunks_[chunk_].size() - used_ < n) {
      ++chunk_;
      used_ = 0;
    }
    if (chunk_ == chunks_.size()) chunks_.emplace_back(std::max(n, chunk_size));
    return chunks_[chunk_].data() + used_;
  }
  /// The first n of them were.
  void take(std::size_t n) { used_ += n; }

 private:
  static constexpr std::size_t chunk_size = std::size_t{1} << 16;
  std::vector<column<std::uint32_t>> chunks_;
  std::size_t chunk_ = 0, used_ = 0;
};

/// Pairs by rows: all partners of fluid particle i follow each other, so i is stored once. Each pair of fluid is in the
/// row of one of the two, which a half stencil finds.
class pair_rows {
 public:
  struct row {
    const std::uint32_t *fluid, *boundary, *end;  ///< partners: fluid ones from `fluid` on, then boundary ones
    std::size_t size() const { return static_cast<std::size_t>(end - fluid); }
  };
  const row& operator[](std::size_t i) const { return rows_[i]; }

  /// All pairs nearer than the reaches; `boundary_reach2` of 0 finds no boundary partners. The same rows for every
  /// team.
  template <int D, class R, class Probe>
  void build(const positions<D, R>& x, const cells<D>& c, std::size_t fluid_count, R reach2, R boundary_reach2,
             const team& t, Probe& probe) {
    rows_.resize(fluid_count);
    // Pieces are small and dealt out in turns, as cells hold very different numbers of pairs.
    const std::size_t pieces = t.threads() == 1 ? 1 : 16 * static_cast<std::size_t>(t.threads());
    pools_.resize(pieces);
    t.for_each(pieces, [&](std::size_t piece) {
      pools_[piece].restart();
      const std::size_t begin = c.fluid_cells * piece / pieces, end = c.fluid_cells * (piece + 1) / pieces;
      for (std::size_t cell = begin + 1; cell <= end; ++cell)
        sweep_cell(c, cell, probe, [&](std::uint32_t i, const auto& fluid, const auto& boundary) {
          rows_[i] = row_of(pools_[piece], x, x[i], reach2, fluid, boundary_reach2, boundary, probe);
        });
    });
  }

 private:
  template <int D, class R, class FluidRanges, class BoundaryRanges, class Probe>
  static row row_of(list_pool& pool, const positions<D, R>& x, const vec<D, R>& x_i, R reach2, const FluidRanges& fluid,
                    R boundary_reach2, const BoundaryRanges& boundary, Probe& probe) {
    using filter = candidate_filter<D, R>;
    std::uint32_t* to = pool.room_for(filter::size(fluid) + filter::size(boundary));
    row found{to, to, to};
    const auto append = [&](std::uint32_t j) __attribute__((always_inline)) { *to++ = j; };
    const std::size_t n = filter::each_in_reach(x, x_i, reach2, fluid, append);
    found.boundary = to;
    const std::size_t m =
        boundary_reach2 > 0 ? filter::each_in_reach(x, x_i, boundary_reach2, boundary, append) : std::size_t{0};
    found.end = to;
    pool.take(n + m);
    if constexpr (Probe::counting) {
      probe.tested(filter::size(fluid) + filter::size(boundary));
      probe.fluid_pairs(n);
      probe.boundary_pairs(m);
    }
    return found;
  }

  column<row> rows_;
  std::vector<list_pool> pools_;
};

/// Sums the pairs of row i, all of which interact.
template <class I, class Probe>
PAIRSUM_SAME_CODE void sum_row(const problem<I>& p, const pair_rows& rows, std::size_t i, Probe& probe) {
  using real = typename I::real;
  const pair_rows::row& row = rows[i];
  const auto x_i = p.position(i);
  const auto a = p.fluid.load(i);
  auto u_i = zero<rates_of<I>>();
  for (const std::uint32_t* k = row.fluid; k != row.boundary; ++k) {
    const vec<I::dim, real> r = x_i - p.position(*k);
    const auto c = p.formula->pair(r, norm2<I::dim, real>(r), a, p.fluid.load(*k));
    add(u_i, c.to_i);
    p.u.add(*k, c.to_j);
  }
  if constexpr (has_boundary<I>)
    for (const std::uint32_t* k = row.boundary; k != row.end; ++k) {
      const vec<I::dim, real> r = x_i - p.position(*k);
      add(u_i, p.formula->boundary(r, norm2<I::dim, real>(r), a, p.boundary_particle(*k)));
    }
  p.u.add(i, u_i);
  if constexpr (Probe::counting) probe.evaluated(row.size());
}

}  // namespace pairsum

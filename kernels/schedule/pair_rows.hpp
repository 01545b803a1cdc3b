#pragma once
#include <algorithm>
#include <vector>

#include <pairsum/core/team.hpp>
#include <pairsum/sum/problem.hpp>

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
template <int D, class R>
class pair_rows {
 public:
  const row* data() const { return rows_.data(); }

  /// All pairs closer than the cutoffs of the space, whose order is that of the particles. The same rows for every
  /// team.
  void build(const problem<D, R>& p, const search_space<D, R>& space, const team& t, work_counts* counts) {
    rows_.resize(p.fluid_count);
    // Pieces are small and dealt out in turns, as cells hold very different numbers of pairs.
    const std::size_t pieces = t.threads() == 1 ? 1 : 16 * static_cast<std::size_t>(t.threads());
    pools_.resize(pieces);
    const cells<D>& c = p.cells();
    t.for_each(pieces, [&](std::size_t piece) {
      pools_[piece].restart();
      const keeper to{rows_.data(), &pools_[piece]};
      const row_sink sink{&keep, &to, p.spare_of(0)};
      const std::size_t begin = c.fluid_cells * piece / pieces, end = c.fluid_cells * (piece + 1) / pieces;
      for (std::size_t cell = begin + 1; cell <= end; ++cell) {
        const cell_range& own = c.range[cell];
        for (std::uint32_t i = own.fluid.begin; i < own.fluid.end; ++i) rows_[i] = {nullptr, nullptr, 0, 0, i};
        const meeting<D> m = half_stencil(c, cell, counts);
        list_meetings(p, space, sink, &m, 1, counts);
      }
    });
  }

 private:
  struct keeper {
    row* rows;
    list_pool* pool;
  };
  /// Copies rows. Vector units may pass a particle's fluid partners in several rows, and its boundary partners
  /// separately.
  static void keep(const void* call, const row* rows, std::size_t n) {
    const auto& to = *static_cast<const keeper*>(call);
    for (std::size_t k = 0; k < n; ++k) {
      const row& from = rows[k];
      row& own = to.rows[from.i];
      const std::size_t size = own.fluid_count + own.boundary_count + from.fluid_count + from.boundary_count;
      std::uint32_t* at = to.pool->room_for(size);
      row joined{at, nullptr, own.fluid_count + from.fluid_count, own.boundary_count + from.boundary_count, from.i};
      at = std::copy_n(own.fluid, own.fluid_count, at);
      at = std::copy_n(from.fluid, from.fluid_count, at);
      joined.boundary = at;
      at = std::copy_n(own.boundary, own.boundary_count, at);
      std::copy_n(from.boundary, from.boundary_count, at);
      to.pool->take(size);
      own = joined;
    }
  }

  column<row> rows_;
  std::vector<list_pool> pools_;
};

}  // namespace pairsum

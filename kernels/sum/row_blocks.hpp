#pragma once
#include <string>

#include "core/omp_loop.hpp"
#include "sum/block_setup.hpp"
#include "sum/pair_rows.hpp"

namespace pairsum {

/// A list of pairs by rows, with the coloured blocks of cells in which threads sum it: a row's partners lie in the cell
/// of its particle or in a neighbour, and blocks of a colour are at least two cells apart (sum/cell_blocks.hpp).
template <class I>
struct row_blocks {
  pair_rows rows;
  cell_blocks<I::dim> blocks;

  /// Throws pairsum::error for a block that is not to be had.
  void configure(const setup& s) { shape_blocks(blocks, s, column_bytes_per_cell<I>()); }
  std::string block() const { return blocks.shape().word(); }

  /// f(i) for every fluid particle, colour by colour, on the threads of the team.
  template <class Probe, class F>
  void each_row(const problem<I>& p, const team& t, const granularity& own, Probe& probe, F&& f) const {
    const granularity g = t.granularity_or(own);
    probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
    for (unsigned colour = 0; colour < blocks.colours(); ++colour)
      omp_pass(colour, blocks.size(colour), g, probe, [&](std::size_t k) {
        for (const std::uint32_t cell : blocks(colour, k)) {
          const cell_range& of = p.cells().range[cell];
          for (std::uint32_t i = of.fluid_begin; i < of.fluid_end; ++i) f(i);
        }
      });
  }
};

}  // namespace pairsum

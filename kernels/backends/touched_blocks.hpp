#pragma once
// Half-stencil sweeps over pieces of the cells, with private buffers for the few particles that two pieces write to:
//
//   prepare:  cut the cells into pieces; list the blocks of 64 particles that each piece writes to
//   sum:      parallel for pieces:
//               buffers of the piece = 0
//               for i in piece, for j in reach of i, later in its cell or in a forward neighbour:
//                 c = f(i, j), added to the buffer if another piece writes to the block, else to the rates
//   reduce:   parallel for blocks with buffers:  u += the buffers, in the order of the pieces
//
//     piece 1  [####====]                 =  blocks that two pieces write to: only these have buffers, are zeroed and
//     piece 2      [====####====]            added up
//     piece 3              [====####]
//
// Race-free: a block without buffers has one writer, and a buffer belongs to one piece. Bit-identical for every number
// of threads: pieces depend on the particles alone, and buffers are added up in their order.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/fetch.hpp"
#include "sum/half_stencil.hpp"
#include "sum/private_columns.hpp"
#include "sum/touched_pieces.hpp"

namespace pairsum {

struct touched_blocks {
  static constexpr backend_traits traits{
      .name = "touched_blocks",
      .description = "sweeps over pieces with OpenMP; what several touch is buffered in blocks and reduced in order",
      .aliases = "Newton-3, ordered reduction of touched blocks (GROMACS nbnxm)",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::dynamic, 1},
      .colours = {1, 1, 1},
      .conflicts = conflict_avoidance::copies};

  template <class I>
  struct workspace {
    using pieces_of_cells = touched_pieces<I::dim>;
    static constexpr std::size_t block_size = pieces_of_cells::block_size;

    /// Rates as a piece adds to them.
    struct piece_rates {
      field_pointers<rates_of<I>> u, buffer;
      const std::uint32_t* slot;  ///< by block

      [[gnu::always_inline]] void add(std::size_t i, const rates_of<I>& a) const {
        const std::size_t at = slot[i / block_size];
        if (at == pieces_of_cells::alone)
          u.add(i, a);
        else
          buffer.add(at * block_size + i % block_size, a);
      }
    };

    pieces_of_cells pieces;
    field_columns<rates_of<I>> buffer;
    std::vector<column<std::uint32_t>> slot_of_block;  ///< of a thread's piece

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe&) {
      pieces.build(p.cells(), p.fluid_count, t);
      buffer.resize(pieces.slots() * block_size);
      slot_of_block.resize(static_cast<std::size_t>(t.threads()));
      for (auto& slots : slot_of_block) slots.resize(pieces.blocks());
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      check_prepared(static_cast<int>(slot_of_block.size()), t);
      const granularity g = t.granularity_or(traits.loop);
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      {
        auto& slots = slot_of_block[static_cast<std::size_t>(omp_get_thread_num())];
        const piece_rates u{p.u, buffer.pointers(), slots.data()};
        omp_pass(0, pieces.size(), g, probe, [&](std::size_t k) {
          for (const auto& touched : pieces[k].touched) {
            slots[touched.block] = touched.slot;
            if (touched.slot != pieces_of_cells::alone)
              zero_range(u.buffer, touched.slot * block_size, (touched.slot + 1) * block_size);
          }
          for (std::size_t cell = pieces[k].cell_begin; cell < pieces[k].cell_end; ++cell) {
            fetch_for_next_cell<true>(p, cell);
            sweep_cell<I::dim>(p.cells(), cell, probe, [&](std::uint32_t i, const auto& fluid, const auto& boundary) {
              scatter_one_to(u, p, i, fluid, boundary, probe);
            });
          }
        });
      }
    }

    void reduce(const problem<I>& p, const team& t) {
      const auto from = buffer.pointers();
      t.for_pieces(pieces.blocks(), [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t b = begin; b < end; ++b)
          for (std::size_t slot = pieces.first_slot(b); slot < pieces.first_slot(b + 1); ++slot)
            for (std::size_t k = 0; k < block_size && b * block_size + k < p.fluid_count; ++k)
              p.u.add(b * block_size + k, from.load(slot * block_size + k));
      });
    }
  };
};

}  // namespace pairsum

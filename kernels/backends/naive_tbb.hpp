#pragma once
// Reference loop: that of naive, the cells shared out among the threads of a oneTBB arena.
//
// Race-free: a cell's visit writes the rates of that cell's particles alone, and each cell is visited once.
#include "core/tbb_loop.hpp"
#include "sum/backend.hpp"
#include "sum/gather_cell.hpp"

namespace pairsum {

struct naive_tbb {
  static constexpr backend_traits traits{
      .name = "naive_tbb",
      .description = "gather, parallel over cells with oneTBB; each pair is seen twice",
      .aliases = "one-sided, full neighbourhood, no Newton-3, c01",
      .threads = runtime::tbb,
      .symmetric = false,
      .deterministic = true,
      .accumulates = false,
      .evaluations_per_pair = 2,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::automatic, 64},
      .conflicts = conflict_avoidance::gather};

  template <class I>
  struct workspace {
    template <class Probe>
    void prepare(const problem<I>&, const team&, Probe&) {}

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      t.arena().arena.execute([&] {
        tbb_pass(0, 1, p.cells().fluid_cells + 1, g, probe, [&](std::size_t c) { gather_cell_in_order(p, c, probe); });
      });
    }
  };
};

}  // namespace pairsum

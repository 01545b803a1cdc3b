#pragma once
// Reference loop: that of naive, the cells shared out among OpenMP threads.
//
// Race-free: a cell's visit writes the rates of that cell's particles alone, and each cell is visited once.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/gather_cell.hpp"

namespace pairsum {

struct naive_omp {
  static constexpr backend_traits traits{
      .name = "naive_omp",
      .description = "gather, parallel over cells with OpenMP; each pair is seen twice",
      .aliases = "one-sided, full neighbourhood, no Newton-3, c01",
      .threads = runtime::omp,
      .symmetric = false,
      .deterministic = true,
      .accumulates = false,
      .evaluations_per_pair = 2,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::dynamic, 64},
      .conflicts = conflict_avoidance::gather};

  template <class I>
  struct workspace {
    template <class Probe>
    void prepare(const problem<I>&, const team&, Probe&) {}

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const std::size_t n = p.cells().fluid_cells;
      const granularity g = t.granularity_or(traits.loop);
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      omp_pass(0, n, g, probe, [&](std::size_t c) { gather_cell_in_order(p, c + 1, probe); });
    }
  };
};

}  // namespace pairsum

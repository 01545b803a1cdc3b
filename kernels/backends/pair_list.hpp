#pragma once
// The list of Liu & Liu ("Smoothed Particle Hydrodynamics", World Scientific 2003, ch. 4):
//
//   prepare:  list = all interacting pairs (i, j), each once, found through the cells
//   sum:      for (i, j) in list:  c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
// The list is kept by rows: all partners of i follow each other, so i is stored once. Race-free: one thread.
#include "sum/backend.hpp"
#include "sum/pair_rows.hpp"

namespace pairsum {

struct pair_list {
  static constexpr backend_traits traits{
      .name = "pair_list",
      .description = "Liu & Liu: list of interacting pairs (prepare), then one serial symmetric sweep (sum)",
      .aliases = "half neighbour list, Verlet list without skin, Newton-3",
      .threads = runtime::serial,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = true,
      .conflicts = conflict_avoidance::serial};

  template <class I>
  struct workspace {
    pair_rows rows;

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe& probe) {
      rows.build(p.x, p.cells(), p.fluid_count, p.reach2, p.boundary_reach2, t, probe);
    }

    template <class Probe>
    void sum(const problem<I>& p, const team&, Probe& probe) {
      for (std::size_t i = 0; i < p.fluid_count; ++i) sum_row(p, rows, i, probe);
    }
  };
};

}  // namespace pairsum

#pragma once
// Reference loop:
//
//   for each fluid particle i:
//     u_i = 0
//     for each of the 3^d cells around i's cell, for each particle j != i in it:
//       if |x_i - x_j| < H:  u_i += f(i, j)
//
// Race-free: one thread.
#include "sum/backend.hpp"
#include "sum/gather_cell.hpp"

namespace pairsum {

struct naive {
  static constexpr backend_traits traits{
      .name = "naive",
      .description = "gather, serial: each particle collects from its 3^d cells; each pair is seen twice",
      .aliases = "one-sided, full neighbourhood, no Newton-3, c01",
      .threads = runtime::serial,
      .symmetric = false,
      .deterministic = true,
      .accumulates = false,
      .evaluations_per_pair = 2,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .conflicts = conflict_avoidance::serial};

  template <class I>
  struct workspace {
    template <class Probe>
    void prepare(const problem<I>&, const team&, Probe&) {}

    template <class Probe>
    void sum(const problem<I>& p, const team&, Probe& probe) {
      for (std::size_t c = 1; c <= p.cells().fluid_cells; ++c) gather_cell_in_order(p, c, probe);
    }
  };
};

}  // namespace pairsum

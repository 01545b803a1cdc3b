#pragma once
// One half-stencil sweep by all threads at once, each adding to a copy of the rates of its own:
//
//   zero:    every copy u^t = 0                                 each thread its own
//   sum:     parallel for fluid cells B, by thread t:
//              for i in B, for j in reach of i in B and forward:   c = f(i, j);  u^t_i += c.to_i;  u^t_j += c.to_j
//   reduce:  u = u^0 + u^1 + ... + u^(T-1)                      parallel over particles
//
//      u^0 [#########..............]        all of it is zeroed and added up, whatever a thread touched: memory and
//      u^1 [.......########........]        the work of reduce grow with the threads
//      u^2 [..............#########]
//
// Race-free: thread t writes to u^t alone, and u^0 is the rates. Which pairs a thread gets is chance, so the last bits
// are too.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/private_columns.hpp"
#include "sum/scatter_cell.hpp"

namespace pairsum {

struct thread_private {
  static constexpr backend_traits traits{
      .name = "thread_private",
      .description = "half-stencil sweep with OpenMP, a full copy of the rates per thread, parallel reduction",
      .aliases = "Newton-3 with private arrays (LAMMPS OPENMP, early DualSPHysics), array reduction",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = false,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::dynamic, 32},
      .colours = {1, 1, 1},
      .conflicts = conflict_avoidance::copies};

  template <class I>
  struct workspace {
    private_columns<I> copies;

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe&) {
      copies.resize(static_cast<std::size_t>(t.threads()), p.fluid_count);
    }

    void zero(const problem<I>& p, const team& t) {
      t.for_each(copies.copies(), [&](std::size_t k) { zero_range(copies.with_copy(p, k).u, 0, p.fluid_count); });
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      check_prepared(static_cast<int>(copies.copies()), t);
      const granularity g = t.granularity_or(traits.loop);
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      {
        const problem<I> own = copies.with_copy(p, static_cast<std::size_t>(omp_get_thread_num()));
        omp_pass(0, p.cells().fluid_cells, g, probe, [&](std::size_t k) { scatter_cell_in_order(own, k + 1, probe); });
      }
    }

    void reduce(const problem<I>& p, const team& t) { copies.join(p, t); }
  };
};

}  // namespace pairsum

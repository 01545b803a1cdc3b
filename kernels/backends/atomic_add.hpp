#pragma once
// One half-stencil sweep by all threads at once, every update atomic:
//
//   parallel for fluid cells B:
//     for i in B, for j in reach of i in B (later ones) and in its forward neighbours:
//       c = f(i, j);  u_i += c.to_i in registers;  atomically u_j += c.to_j
//     atomically u_i += its sum
//
//                      thread 1           thread 2         both may add to the cells between:
//                    [ B ][ > ]         [ B ][ > ]         each addition reads, adds, and writes again if nobody
//                [ ^ ][ ^ ][ ^ ]    [ ^ ][ ^ ][ ^ ]        else wrote in between
//
// Race-free: nothing is written but by atomic additions. One sweep, no barrier, no memory, no colours; each pair costs
// an atomic addition per rate. The order in which a particle's rate is added to is chance, so the last bits are too.
//
// Threads begin with large shares of the cells, far from each other: with small ones, dealt out in turns, they add to
// the same cache lines nearly all the time, and two take as long as one.
#include <atomic>

#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/fetch.hpp"
#include "sum/half_stencil.hpp"

namespace pairsum {

/// Columns that other threads add to at the same time.
template <class S>
struct atomic_columns {
  field_pointers<S> to;

  [[gnu::always_inline]] void add(std::size_t i, const S& s) const {
    each_scalar(
        s, [&](const auto& a, int slot) __attribute__((always_inline)) {
          using scalar = std::remove_cvref_t<decltype(a)>;
          std::atomic_ref(to.template column_as<scalar>(slot)[i]).fetch_add(a, std::memory_order_relaxed);
        });
  }
};

struct atomic_add {
  static constexpr backend_traits traits{.name = "atomic_add",
                                         .description = "half-stencil sweep with OpenMP, every update an atomic add",
                                         .aliases = "Newton-3 with atomics (Kokkos, ExaMiniMD, Cabana)",
                                         .threads = runtime::omp,
                                         .symmetric = true,
                                         .deterministic = false,
                                         .accumulates = true,
                                         .evaluations_per_pair = 1,
                                         .sweeps_per_colour = false,
                                         .keeps_pairs = false,
                                         .loop = {schedule::guided, 64},
                                         .colours = {1, 1, 1},
                                         .conflicts = conflict_avoidance::atomics};

  template <class I>
  struct workspace {
    template <class Probe>
    void prepare(const problem<I>&, const team&, Probe&) {}

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      const atomic_columns<rates_of<I>> u{p.u};
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      omp_pass(0, p.cells().fluid_cells, g, probe, [&](std::size_t k) {
        fetch_for_next_cell<true>(p, k + 1);
        sweep_cell<I::dim>(p.cells(), k + 1, probe, [&](std::uint32_t i, const auto& fluid, const auto& boundary) {
          scatter_one_to(u, p, i, fluid, boundary, probe);
        });
      });
    }
  };
};

}  // namespace pairsum

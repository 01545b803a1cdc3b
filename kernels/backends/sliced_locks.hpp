#pragma once
// One slab of cell layers per thread, a lock where two slabs meet. In 2D, 3 threads, layers going up:
//
//   | 8  8  8  8 |  thread 2      layer l writes to l and l+1 only (half stencil), so of a slab [a, b) only layer b,
//   | 7  7  7  7 |                the first of the next slab, is another thread's too:
//   |=6==6==6==6=|  lock 2
//   | 5  5  5  5 |  thread 1        parallel for slabs [a, b):
//   | 4  4  4  4 |                    hold lock(a):  sweep layer a        for cell in layer, for i in cell:
//   |=3==3==3==3=|  lock 1            sweep layers a+1 .. b-2               for j > i in cell, j in forward cells:
//   | 2  2  2  2 |                    hold lock(b):  sweep layer b-1          u_i += f(i,j), u_j += f(j,i)
//   | 1  1  1  1 |  thread 0
//
// Race-free: layer b is written in the sweeps of layers b-1 and b alone, both under lock(b); all other layers of a slab
// by its thread alone. Threads start with their first layer and end with their last, so that they seldom wait. A slab
// of one layer holds both locks; locks are taken in ascending order, so nobody waits in a ring, not even where the grid
// closes on itself and the last slab's neighbour is the first. Which of two slabs adds first to layer b is left to
// chance, and there are as many slabs as threads: not bit-identical.
#include "core/omp_locks.hpp"
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/slabs.hpp"

namespace pairsum {

/// Locks of another type are for tests, which leave them out.
template <class I, class Locks>
struct sliced_workspace {
  std::vector<cell_layer> layers;
  std::vector<std::uint64_t> work;
  std::vector<slab> slabs;
  Locks locks;

  template <class Probe>
  void prepare(const problem<I>& p, const team& t, Probe&) {
    find_layers(p.cells(), layers);
    work.resize(layers.size());
    t.for_pieces(layers.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t k = begin; k < end; ++k) work[k] = candidates_in(p.cells(), layers[k]);
    });
    slabs = cut_slabs(layers, work, layers_around(p.cells()), static_cast<std::size_t>(t.threads()));
    locks.resize(slabs.size());
  }

  /// On any number of threads: no slab waits for one that has not begun.
  template <class Probe>
  void sum(const problem<I>& p, const team& t, const granularity& own, Probe& probe) {
    const granularity g = t.granularity_or(own);
    probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
    omp_pass(0, slabs.size(), g, probe, [&](std::size_t k) {
      const auto wait = [&probe, thread = omp_get_thread_num()](auto&& until_free) {  // no work, for who observes
        probe.work_ends(0, thread);
        until_free();
        probe.work_begins(0, thread);
      };
      for (const stretch& s : slabs[k]) {
        const typename Locks::guard held(locks, s.low, s.high, wait);
        sweep_cells(p, s.begin, s.end, probe);
      }
    });
  }
};

struct sliced_locks {
  static constexpr backend_traits traits{
      .name = "sliced_locks",
      .description = "half-stencil sweep, a slab of cell layers per OpenMP thread, a lock where two slabs meet",
      .aliases = "sliced (AutoPas), slices (DualSPHysics), domain slicing, Newton-3 with locks",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = false,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::fixed, 1},
      .colours = {1, 1, 1},
      .conflicts = conflict_avoidance::locks};

  template <class I>
  struct workspace : sliced_workspace<I, omp_locks> {
    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      sliced_workspace<I, omp_locks>::sum(p, t, traits.loop, probe);
    }
  };
};

}  // namespace pairsum

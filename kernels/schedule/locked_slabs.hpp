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
// of one layer holds both locks; locks are taken in ascending order, so there is no deadlock, not even where the grid
// closes on itself and the last slab's neighbour is the first. Two slabs add to layer b in any order, and there are as
// many slabs as threads: not bit-identical.
#include <pairsum/core/omp_locks.hpp>
#include <pairsum/core/omp_loop.hpp>
#include <pairsum/schedule/cell_sweep.hpp>
#include <pairsum/schedule/slabs.hpp>

namespace pairsum {

/// Locks of another type are for tests, which leave them out.
template <int D, class R, class Locks>
class slabs_with : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "half-stencil sweep, a slab of cell layers per thread, a lock where two slabs meet",
      .aliases = "sliced (AutoPas), slices (DualSPHysics), domain slicing, Newton-3 with locks",
      .deterministic = false,
      .loop = {loop_schedule::fixed, 1},
      .conflicts = conflict_avoidance::locks};

  void prepare(const P& p, const team& t) override {
    find_layers(p.cells(), layers_);
    work_.resize(layers_.size());
    t.for_pieces(layers_.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t k = begin; k < end; ++k) work_[k] = candidates_in(p.cells(), layers_[k]);
    });
    slabs_ = cut_slabs(layers_, work_, layers_around(p.cells()), static_cast<std::size_t>(t.threads()));
    locks_.resize(slabs_.size());
  }
  std::size_t size(const P&, unsigned) const override { return slabs_.size(); }
  void unit(const P& p, unsigned, std::size_t k, int thread) override { sweep(p, k, thread, pass_marks()); }
  void sum(const P& p, const team& t, const backend_traits& own, const pass_marks& marks) override {
    const granularity g = t.granularity_or(own.loop);
    marks.pass_begins(0);
    omp_region(t.threads(), [&](int thread) {
      omp_pass(0, slabs_.size(), g, marks, thread, [&](std::size_t k) { sweep(p, k, thread, marks); });
    });
  }

 private:
  /// On any number of threads: no slab waits for one that has not begun.
  void sweep(const P& p, std::size_t k, int thread, const pass_marks& marks) {
    const auto wait = [&](auto&& until_free) {  // counts as waiting for the observer
      marks.work_ends(0, thread);
      until_free();
      marks.work_begins(0, thread);
    };
    for (const stretch& s : slabs_[k]) {
      const typename Locks::guard held(locks_, s.low, s.high, wait);
      sweep_cells(p, s.begin, s.end, p.to(thread));
    }
  }

  std::vector<cell_layer> layers_;
  std::vector<std::uint64_t> work_;
  std::vector<slab> slabs_;
  Locks locks_;
};

template <int D, class R>
using locked_slabs = slabs_with<D, R, omp_locks>;

}  // namespace pairsum

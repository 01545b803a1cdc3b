// One half-stencil sweep by all threads at once, every update atomic:
//
//   parallel for fluid cells B:
//     for i in B, for j within H of i in B (later ones) and in its forward neighbours:
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
#include <pairsum/schedule/cell_sweep.hpp>

namespace pairsum {

template <int D, class R>
class atomic_cells final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{.description = "half-stencil sweep, every update an atomic add",
                                         .aliases = "Newton-3 with atomics (Kokkos, ExaMiniMD, Cabana)",
                                         .deterministic = false,
                                         .loop = {loop_schedule::guided, 64},
                                         .conflicts = conflict_avoidance::atomics};

  std::size_t size(const P& p, unsigned) const override { return p.cells().fluid_cells; }
  void unit(const P& p, unsigned, std::size_t k, int thread) override {
    target to = p.to(thread);
    to.how = update::atomic;
    sweep_cell_in_order(p, k + 1, to);
  }
};

}  // namespace pairsum

PAIRSUM_BACKEND(atomic_add, atomic_cells, omp)

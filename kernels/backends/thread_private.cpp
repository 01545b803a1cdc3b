// One half-stencil sweep by all threads at once, each adding to a copy of the rates of its own:
//
//   zero:    every copy u^t = 0                                 each thread its own
//   sum:     parallel for fluid cells B, by thread t:
//              for i in B, for j within H of i in B and forward:   c = f(i, j);  u^t_i += c.to_i;  u^t_j += c.to_j
//   reduce:  u = u^0 + u^1 + ... + u^(T-1)                      parallel over particles
//
//      u^0 [#########..............]        all of it is zeroed and added up, whatever a thread touched: memory and
//      u^1 [.......########........]        the work of reduce grow with the threads
//      u^2 [..............#########]
//
// Race-free: thread t writes to u^t alone, and u^0 is the rates. Which pairs a thread gets is chance, so the last bits
// are too.
#include <pairsum/schedule/cell_sweep.hpp>
#include <pairsum/sum/rate_copies.hpp>

namespace pairsum {

template <int D, class R>
class thread_copies final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "half-stencil sweep, a full copy of the rates per thread, parallel reduction",
      .aliases = "Newton-3 with private arrays (LAMMPS OPENMP, early DualSPHysics), array reduction",
      .deterministic = false,
      .loop = {loop_schedule::dynamic, 32},
      .conflicts = conflict_avoidance::copies};

  void prepare(const P& p, const team& t) override { copies_.resize(static_cast<std::size_t>(t.threads()), p); }
  void zero(const P& p, const team& t) override {
    t.for_each(copies_.size(), [&](std::size_t k) { p.pairs->zero(copies_.of(p, k), 0, p.rate_rows()); });
  }
  std::size_t size(const P& p, unsigned) const override { return p.cells().fluid_cells; }
  void unit(const P& p, unsigned, std::size_t k, int thread) override {
    sweep_cell_in_order(p, k + 1, {.u = copies_.of(p, static_cast<std::size_t>(thread)), .thread = thread});
  }
  void reduce(const P& p, const team& t) override { copies_.join(p, t); }

 private:
  rate_copies<D, R> copies_;
};

}  // namespace pairsum

PAIRSUM_BACKEND(thread_private, thread_copies, omp)

#pragma once
// Reference loop:
//
//   for each fluid particle i:
//     u_i = 0
//     for each of the 3^d cells around i's cell, for each particle j != i in it:
//       if |x_i - x_j| < H:  u_i += f(i, j)
//
// Race-free: a cell's visit writes the rates of that cell's particles alone, and each cell is visited once.
#include <pairsum/sum/prefetch.hpp>
#include <pairsum/sum/schedule.hpp>

namespace pairsum {

template <int D, class R>
class gather_cells final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "gather: each particle collects from its 3^d cells; each pair is seen twice",
      .aliases = "one-sided, full neighbourhood, no Newton-3, c01",
      .symmetric = false,
      .loop = {loop_schedule::dynamic, 64},
      .conflicts = conflict_avoidance::gather};

  std::size_t size(const P& p, unsigned) const override { return p.cells().fluid_cells; }
  void unit(const P& p, unsigned, std::size_t k, int thread) override {
    const target to = p.to(thread);
    fetch_for_next_cell<false>(p, k + 1, to);
    sum_meetings(p, to, full_stencil(p.cells(), k + 1));
  }
};

}  // namespace pairsum

#pragma once
// One cell with its forward neighbours at a time, coloured so that no two at a time share a cell:
//
//   for each colour:                                      18 in 3D, 6 in 2D, 2 in 1D; a barrier after each
//     parallel for cells B of the colour:
//       for i in B, for j within H of i in B (later ones) and in the forward neighbours:
//         c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
//     ^ ^ ^  ^ ^ ^  ^ ^ ^        2D: what the cells B of one colour write to,
//     . B >  . B >  . B >        3 cells by 2 for each
//
// Race-free: the sets of cells that two cells of a colour write to are disjoint (schedule/coloured_cells.hpp); on a
// torus, whose 2^M cells are no multiple of 3, cells at the seam have their own colours. Bit-identical for every number
// of threads: neither colours nor the order in a cell depend on it.
#include <pairsum/schedule/cell_sweep.hpp>
#include <pairsum/schedule/coloured_cells.hpp>

namespace pairsum {

template <int D, class R>
class half_stencil_colours final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{.description = "half stencil per cell, 18 colours in 3D",
                                         .aliases = "Newton-3, c18 (AutoPas)",
                                         .sweeps_per_colour = true,
                                         .loop = {loop_schedule::dynamic, 32},
                                         .colours = {2, 6, 18}};

  void prepare(const P& p, const team&) override { cells_.build(p.cells()); }
  unsigned colours(const P&) const override { return cells_.colours(); }
  std::size_t size(const P&, unsigned colour) const override { return cells_[colour].size(); }
  void unit(const P& p, unsigned colour, std::size_t k, int thread) override {
    const auto& list = cells_[colour];
    if (k + 1 < list.size()) fetch_half_stencil(p, list[k + 1], p.to(thread));
    sweep_cell(p, list[k], p.to(thread));
  }

 private:
  coloured_cells<D> cells_;
};

}  // namespace pairsum

#pragma once
// One cell with its forward neighbours at a time, coloured so that no two at a time share a cell:
//
//   for each colour:                                      18 in 3D, 6 in 2D, 2 in 1D; a barrier after each
//     parallel for cells B of the colour:
//       for i in B, for j in reach of i in B (later ones) and in the forward neighbours:
//         c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
//     ^ ^ ^  ^ ^ ^  ^ ^ ^        2D: what the cells B of one colour write to,
//     . B >  . B >  . B >        3 cells by 2 for each
//
// Race-free: the sets of cells that two cells of a colour write to do not meet (sum/coloured_cells.hpp); on a torus,
// whose 2^M cells no 3 divides, cells at the seam have colours of their own. Bit-identical for every number of threads:
// neither colours nor the order in a cell depend on it.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/coloured_cells.hpp"
#include "sum/scatter_cell.hpp"

namespace pairsum {

struct colour18 {
  static constexpr backend_traits traits{.name = "colour18",
                                         .description = "half stencil per cell, 18 colours in 3D, with OpenMP",
                                         .aliases = "Newton-3, c18 (AutoPas)",
                                         .threads = runtime::omp,
                                         .symmetric = true,
                                         .deterministic = true,
                                         .accumulates = true,
                                         .evaluations_per_pair = 1,
                                         .sweeps_per_colour = true,
                                         .keeps_pairs = false,
                                         .loop = {schedule::dynamic, 32},
                                         .colours = {2, 6, 18},
                                         .conflicts = conflict_avoidance::colours};

  template <class I>
  struct workspace {
    coloured_cells<I::dim> by_colour;

    template <class Probe>
    void prepare(const problem<I>& p, const team&, Probe&) {
      by_colour.build(p.cells());
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      if (by_colour.colours() > 0) probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      for (unsigned colour = 0; colour < by_colour.colours(); ++colour) {
        const auto& list = by_colour[colour];
        omp_pass(colour, list.size(), g, probe, [&](std::size_t k) {
          if (k + 1 < list.size()) fetch_half_stencil(p, list[k + 1]);
          scatter_cell(p, list[k], probe);
        });
      }
    }
  };
};

}  // namespace pairsum

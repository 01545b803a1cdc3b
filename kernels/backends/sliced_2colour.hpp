#pragma once
// Thin slabs of cell layers in two colours. In 2D, layers going up:
//
//   | 7 7 7 7 |  slab 3, colour 1     for colour in 0, 1:                     2 passes, a barrier between them
//   | 6 6 6 6 |                         parallel for slabs of the colour:
//   | 5 5 5 5 |  slab 2, colour 0         for layer in slab, for cell in layer, for i in cell:
//   | 4 4 4 4 |                             for j > i in cell, j in forward cells:
//   | 3 3 3 3 |  slab 1, colour 1             u_i += f(i,j), u_j += f(j,i)
//   | 2 2 2 2 |
//   | 1 1 1 1 |  slab 0, colour 0     slab 0 writes to layers 0..2, slab 2 to 4..6
//   | 0 0 0 0 |
//
// Race-free: a slab writes to its layers and to the one after them (half stencil); the next slab of its colour begins
// at least two layers further on. Where the grid closes on itself there is an even number of slabs, some a
// layer thicker (sum/slab_colours.hpp). Neither slabs nor their order depend on the threads: bit-identical.
#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/slab_colours.hpp"

namespace pairsum {

struct sliced_2colour {
  static constexpr backend_traits traits{
      .name = "sliced_2colour",
      .description = "half-stencil sweep over thin slabs of cell layers in two colours with OpenMP",
      .aliases = "sliced_c02 (AutoPas), two-colour slicing, Newton-3",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::dynamic, 1},
      .colours = {2, 2, 2},
      .conflicts = conflict_avoidance::colours};

  template <class I>
  struct workspace {
    std::vector<cell_layer> layers;
    std::array<std::vector<slab_cells>, slab_colours::colours> slabs;

    template <class Probe>
    void prepare(const problem<I>& p, const team&, Probe&) {
      find_layers(p.cells(), layers);
      const std::int64_t thickness = slab_thickness(p.fluid_count, layers.size());
      slabs = coloured_slabs(layers, slab_colours(thickness, layers_around(p.cells())));
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      for (unsigned colour = 0; colour < slab_colours::colours; ++colour)
        omp_pass(colour, slabs[colour].size(), g, probe,
                 [&](std::size_t k) { sweep_cells(p, slabs[colour][k].begin, slabs[colour][k].end, probe); });
    }
  };
};

}  // namespace pairsum

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
// layer thicker (schedule/slab_colours.hpp). Neither slabs nor their order depend on the threads: bit-identical.
#include <pairsum/schedule/cell_sweep.hpp>
#include <pairsum/schedule/slab_colours.hpp>

#include <pairsum/sum/schedule.hpp>

namespace pairsum {

template <int D, class R>
class slabs_of_two_colours final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "half-stencil sweep over thin slabs of cell layers in two colours",
      .aliases = "sliced_c02 (AutoPas), two-colour slicing, Newton-3",
      .loop = {loop_schedule::dynamic, 1},
      .colours = {2, 2, 2}};

  void prepare(const P& p, const team&) override {
    find_layers(p.cells(), layers_);
    const std::int64_t thickness = slab_thickness(p.fluid_count, layers_.size());
    slabs_ = coloured_slabs(layers_, slab_colours(thickness, layers_around(p.cells())));
  }
  unsigned colours(const P&) const override { return slab_colours::colours; }
  std::size_t size(const P&, unsigned colour) const override { return slabs_[colour].size(); }
  void unit(const P& p, unsigned colour, std::size_t k, int thread) override {
    sweep_cells(p, slabs_[colour][k].begin, slabs_[colour][k].end, p.to(thread));
  }

 private:
  std::vector<cell_layer> layers_;
  std::array<std::vector<slab_cells>, slab_colours::colours> slabs_;
};

}  // namespace pairsum

// The serial sweep of SPHysics (Dalrymple et al. 2008): every cell meets itself and its forward neighbours. In 2D:
//
//   (-1,1) (0,1) (1,1)          for each cell I:
//          ( I ) (1,0)            sumF1(I);  for each forward neighbour J:  sumF2(I, J)       3D: 13 forward neighbours
//
// Complete, each pair once; not thread-safe as it stands: patterns of neighbouring cells overlap. Race-free here: one
// thread.
#include <pairsum/schedule/cell_sweep.hpp>

namespace pairsum {

template <int D, class R>
class forward_cells final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "SPHysics: half-stencil sweep over cells; each pair once, both updated",
      .aliases = "half stencil, forward neighbours, linked cells with Newton-3"};

  std::size_t size(const P& p, unsigned) const override { return p.cells().fluid_cells; }
  void unit(const P& p, unsigned, std::size_t k, int thread) override { sweep_cell_in_order(p, k + 1, p.to(thread)); }
};

}  // namespace pairsum

PAIRSUM_BACKEND(sphysics_sweep, forward_cells, serial)

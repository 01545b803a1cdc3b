// The block pattern of Sbalzarini et al. (J. Comput. Phys. 215 (2006) 566): the pairs of cells are an explicit list,
// applied with every cell as base in one serial sweep:
//
//   for each cell B:  sumF1(B);  for (j, k) in list:  sumF2(B+j, B+k)      3D: 13 pairs among the 8 cells B + {0,1}^3
//
// It is the talk's pattern without the passes: all neighbours of a pair are at or above B, so no cell looks back.
// Blocks of neighbouring bases overlap. Race-free: one thread.
#include <pairsum/schedule/block.hpp>

namespace pairsum {

template <int D, class R>
class every_base final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{
      .description = "Sbalzarini et al. 2006: the list of cell pairs with every cell as base, one sweep",
      .aliases = "PPM, symmetric cell list, Newton-3"};

  void prepare(const P& p, const team&) override {
    blocks_.clear();
    each_block(p.cells(), 1, p.cells().fluid_cells + 1, [&](unsigned, const block<D>& b) { blocks_.push_back(b); });
  }
  std::size_t size(const P&, unsigned) const override { return blocks_.size(); }
  void unit(const P& p, unsigned, std::size_t k, int thread) override { sum_block_of(p, blocks_, k, p.to(thread)); }

 private:
  column<block<D>> blocks_;
};

}  // namespace pairsum

PAIRSUM_BACKEND(ppm_stencil, every_base, serial)

#include <pairsum/core/places.hpp>
#include <pairsum/schedule/touched_pieces.hpp>

#include <algorithm>

namespace pairsum {
namespace {

/// Enough pieces for many threads, but few, as neighbouring ones share a layer of cells. A few particles are four
/// pieces.
std::size_t pieces_for(std::size_t fluid) {
  return std::clamp<std::size_t>(fluid / 4096, std::clamp<std::size_t>(fluid / 256, 1, 4), 64);
}

}  // namespace

template <int D>
void touched_pieces<D>::build(const cells<D>& c, std::size_t fluid, const team& t) {
  const std::size_t blocks = (fluid + split_block - 1) / split_block;
  pieces_.resize(pieces_for(fluid));
  std::size_t cell = 1;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    pieces_[k].cell_begin = cell;
    const std::size_t goal = fluid * (k + 1) / pieces_.size();
    while (cell <= c.fluid_cells && c.range[cell].fluid.begin < goal) ++cell;
    pieces_[k].cell_end = cell;
  }
  t.for_each(pieces_.size(), [&](std::size_t k) {
    piece& own = pieces_[k];
    std::vector<bool> is_touched(blocks, false);
    for (std::size_t at = own.cell_begin; at < own.cell_end; ++at)
      for (unsigned code = pattern::stencil_centre<D>; code < cells<D>::stencil; ++code) {
        const cell_range& r = c.range[c.neighbour(at, code)];
        if (r.fluid.size() > 0)
          for (std::size_t b = r.fluid.begin / split_block; b <= (r.fluid.end - 1) / split_block; ++b)
            is_touched[b] = true;
      }
    own.touched.clear();
    for (std::size_t b = 0; b < blocks; ++b)
      if (is_touched[b]) own.touched.push_back({static_cast<std::uint32_t>(b), unsplit});
  });
  std::vector<std::uint32_t> writers(blocks, 0);
  for (const piece& p : pieces_)
    for (const touch& touched : p.touched) ++writers[touched.block];
  first_slot_.assign(blocks + 1, 0);
  for (std::size_t b = 0; b < blocks; ++b) first_slot_[b + 1] = first_slot_[b] + (writers[b] > 1 ? writers[b] : 0);
  std::vector<std::uint32_t> next(first_slot_.begin(), first_slot_.end() - 1);
  for (piece& p : pieces_)
    for (touch& touched : p.touched)
      if (writers[touched.block] > 1) touched.slot = next[touched.block]++;
}

#define PAIRSUM_TOUCHED_PIECES(D) template class touched_pieces<D>;
PAIRSUM_EACH_D(PAIRSUM_TOUCHED_PIECES)

}  // namespace pairsum

#include <pairsum/core/places.hpp>
#include <pairsum/schedule/block.hpp>

#include <utility>

namespace pairsum {

template <int D>
void coloured_blocks<D>::build(const cells<D>& c, const team& t) {
  const std::size_t pieces = static_cast<std::size_t>(t.threads());
  std::vector<std::array<std::size_t, most_colours>> next(pieces);
  colours_ = pattern::block_colours(c.period);
  const auto in_pieces = [&](auto&& visit) {
    t.for_pieces(c.fluid_cells,
                 [&](std::size_t begin, std::size_t end, std::size_t piece) { visit(begin + 1, end + 1, piece); });
  };
  in_pieces([&](std::size_t begin, std::size_t end, std::size_t piece) {
    std::array<std::size_t, most_colours> n{};
    each_coloured_block(c, begin, end, [&](unsigned colour, const block<D>&) { ++n[colour]; });
    next[piece] = n;
  });
  for (unsigned o = 0; o < colours_; ++o) {
    std::size_t total = 0;
    for (std::size_t piece = 0; piece < pieces; ++piece) total += std::exchange(next[piece][o], total);
    blocks_[o].resize(total);
  }
  in_pieces([&](std::size_t begin, std::size_t end, std::size_t piece) {
    std::array<std::size_t, most_colours> at = next[piece];
    each_coloured_block(c, begin, end, [&](unsigned colour, const block<D>& b) { blocks_[colour][at[colour]++] = b; });
  });
}

#define PAIRSUM_COLOURED_BLOCKS(D) template class coloured_blocks<D>;
PAIRSUM_EACH_D(PAIRSUM_COLOURED_BLOCKS)

}  // namespace pairsum

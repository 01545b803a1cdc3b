#pragma once
#include <span>
#include <vector>

#include <pairsum/core/places.hpp>
#include <pairsum/schedule/block.hpp>

namespace pairsum {

/// The talk's base blocks in packs of up to 32 base cells in 3D, coloured so that no two packs of a colour share a
/// cell. A pack is a cube of 4^3 cells without its edges, of which those at a body-centred lattice fill space: a cell
/// with at most one component at an end of its four belongs to the pack there, the others to the pack shifted by 2:
///
///     . A A .    a layer of 4 x 4 x 4: A belongs to it, what is at a corner to a pack of the other kind (B).
///     A A A A    In 2D such layers are all there is: plus-shaped packs A and squares B of 2 x 2 between them; in 1D
///     A A A A    runs of four.
///     . A A .
///
/// Packs A have two colours, as a chessboard, packs B two more (in 2D one, which is enough; in 1D there are none): 4.
/// The blocks of a pack reach one cell further, and as packs have no edges, packs of a colour do not meet. Where the
/// pattern does not fit around a torus (its side is no multiple of 8), and only there, a pack may find that its colour
/// is in use at one of its cells. Then it takes another, so that the statement above holds on every grid.
template <int D>
class coloured_packs {
 public:
  static constexpr unsigned pattern_colours = D == 1 ? 2 : D == 2 ? 3 : 4;

  /// Does nothing if the cells are those of the last call. Throws pairsum::error if a torus would need over 32 colours.
  void build(const cells<D>& c);

  unsigned colours() const { return static_cast<unsigned>(packs_.size()); }
  /// Packs of a colour.
  std::size_t size(unsigned colour) const { return packs_[colour].size(); }
  /// The numbers of a pack's blocks in blocks(): [begin, end).
  struct range {
    std::size_t begin, end;
  };
  range operator()(unsigned colour, std::size_t pack) const { return packs_[colour][pack]; }
  const column<block<D>>& blocks() const { return blocks_; }

 private:
  column<block<D>> blocks_;  ///< pack after pack
  std::vector<std::vector<range>> packs_;
  std::uint64_t revision_ = 0;
};

#define PAIRSUM_COLOURED_PACKS(D) extern template class coloured_packs<D>;
PAIRSUM_EACH_D(PAIRSUM_COLOURED_PACKS)
#undef PAIRSUM_COLOURED_PACKS

}  // namespace pairsum

#pragma once
#include <vector>

#include <pairsum/core/places.hpp>
#include <pairsum/core/team.hpp>
#include <pairsum/grid/cells.hpp>
#include <pairsum/sum/rate_view.hpp>

namespace pairsum {

/// The fluid cells in pieces of about as many particles, and which blocks of `split_block` particles a half-stencil
/// sweep over each piece writes to. A block that two pieces write to has a slot for each of them, one behind the other
/// in the order of the pieces; what only one writes to has none.
///
/// Pieces depend on the particles alone, not on the team.
template <int D>
class touched_pieces {
 public:
  struct touch {
    std::uint32_t block, slot;  ///< or `unsplit`
  };
  struct piece {
    std::size_t cell_begin = 1, cell_end = 1;
    std::vector<touch> touched;  ///< ascending
  };

  void build(const cells<D>& c, std::size_t fluid, const team& t);

  std::size_t size() const { return pieces_.size(); }
  const piece& operator[](std::size_t k) const { return pieces_[k]; }
  std::size_t blocks() const { return first_slot_.empty() ? 0 : first_slot_.size() - 1; }
  /// The slots of a block: [first_slot(b), first_slot(b + 1)), none or two and more.
  std::uint32_t first_slot(std::size_t block) const { return first_slot_[block]; }
  std::size_t slots() const { return first_slot_.empty() ? 0 : first_slot_.back(); }

 private:
  std::vector<piece> pieces_;
  std::vector<std::uint32_t> first_slot_;
};

#define PAIRSUM_TOUCHED_PIECES(D) extern template class touched_pieces<D>;
PAIRSUM_EACH_D(PAIRSUM_TOUCHED_PIECES)
#undef PAIRSUM_TOUCHED_PIECES

}  // namespace pairsum

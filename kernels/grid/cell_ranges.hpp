#pragma once
#include <span>
#include <vector>

#include <pairsum/core/team.hpp>
#include <pairsum/grid/cells.hpp>

namespace pairsum {

template <int D, class R>
class grid;

/// Describes the cells of sorted particles: begin, end and neighbours of each.
template <int D>
class cell_ranges {
 public:
  /// keys: (kind, cell) of all particles, ascending, above so many lower bits; fluid and boundary: how many there are.
  /// boundary_kept: those lie where they lay in the last call. renumbered: a key means another cell than in the last
  /// call.
  template <class R>
  void make(std::span<const std::uint32_t> keys, int lower_bits, std::size_t fluid, std::size_t boundary,
            bool boundary_kept, bool renumbered, grid<D, R>& g, const team& t);

  const cells<D>& view() const { return cells_; }

 private:
  void find_cells(std::span<const std::uint32_t> keys, int lower_bits, std::size_t fluid, std::size_t boundary,
                  std::uint32_t cell_mask, const team& t);

  cells<D> cells_;
  column<std::uint32_t> fluid_starts_, boundary_starts_;
  std::vector<std::uint32_t> cell_keys_, last_keys_;  ///< cell keys; entry 0 belongs to the empty cell
  std::size_t last_fluid_cells_ = 0;
};

}  // namespace pairsum

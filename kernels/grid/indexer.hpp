#pragma once
#include <memory>
#include <vector>

#include "grid/counting_sort.hpp"
#include "grid/grid.hpp"
#include "particles/reorder.hpp"

namespace pairsum {

/// Sorts particles by (kind, cell) in place and describes the cells: fluid before boundary before lost, each by
/// ascending cell key, so that a cell's fluid and a cell's boundary are contiguous, and so are those of cells with
/// consecutive keys.
template <int D, class R>
class indexer {
 public:
  indexer(const box<D, R>& omega, std::unique_ptr<grid<D, R>> g) : omega_(omega), grid_(std::move(g)) {}

  /// Particles that are outside Omega (or NaN) become `lost`. Blocks that are sorted already are left alone.
  void build(particle_set<D, R>& p, const team& t);

  const cells<D>& view() const { return cells_; }
  std::size_t fluid() const { return fluid_; }        ///< fluid particles are [0, fluid())
  std::size_t boundary() const { return boundary_; }  ///< boundary particles follow
  std::size_t lost() const { return lost_; }          ///< newly lost in this build

 private:
  void make_keys(particle_set<D, R>& p, const team& t);
  void sort(particle_set<D, R>& p, const team& t);
  void make_cells(const team& t);
  std::vector<std::uint32_t> starts(std::size_t begin, std::size_t end, const team& t) const;

  box<D, R> omega_;
  std::unique_ptr<grid<D, R>> grid_;
  counting_sort counting_sort_;
  reorderer reorder_;
  column<std::uint32_t> keys_;
  std::vector<std::uint32_t> cell_keys_;
  cells<D> cells_;
  std::size_t fluid_ = 0, boundary_ = 0, lost_ = 0;
};

}  // namespace pairsum

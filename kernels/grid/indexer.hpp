#pragma once
#include <memory>
#include <vector>

#include <pairsum/grid/cell_ranges.hpp>
#include <pairsum/grid/counting_sort.hpp>
#include <pairsum/grid/grid.hpp>
#include <pairsum/grid/merge_plan.hpp>
#include <pairsum/particles/reorder.hpp>

namespace pairsum {

/// Sorts particles by (kind, cell) in place and describes the cells: fluid before boundary before lost, each by
/// ascending cell key, so that a cell's fluid and a cell's boundary are contiguous, and so are those of cells with
/// consecutive keys. Ghosts are fluid, and the last of their cell.
///
/// The order is that of a stable sort of the particles as they were passed in, for every team. A build after the first
/// tests the fluid alone and shifts only what the particles that changed their cell displace; if there are none, it
/// changes nothing.
template <int D, class R>
class indexer {
 public:
  indexer(const box<D, R>& omega, std::unique_ptr<grid<D, R>> g) : omega_(omega), grid_(std::move(g)) {}

  /// Particles that are outside Omega (or NaN) become `lost`; along a periodic axis they re-enter through the opposite
  /// face, and only positions that are not finite are lost. From build to build the particles stay in their order and
  /// boundary where it is; else call forget() in between.
  void build(particle_set<D, R>& p, const team& t);

  /// There may be ghosts from now on: the lowest bit of a key says so. Throws pairsum::error if a grid needs that bit.
  void expect_ghosts() {
    ghost_bits_ = 1;
    known_ = false;
  }

  /// Other particles come, or boundary was moved: the next build looks at all of them.
  void forget() { known_ = false; }

  /// Are the particles, as far as is known, those of the last build, and is all fluid still in Omega along
  /// the axes that are not periodic?
  bool holds(const particle_set<D, R>& p, const team& t) const;

  const cells<D>& view() const { return ranges_.view(); }
  std::size_t fluid() const { return fluid_; }        ///< fluid particles, and ghosts, are [0, fluid())
  std::size_t boundary() const { return boundary_; }  ///< boundary particles follow
  std::size_t lost() const { return lost_; }          ///< newly lost in this build

 private:
  void bring_back(particle_set<D, R>& p, std::size_t end, const team& t) const;
  void make_keys(particle_set<D, R>& p, const team& t);
  void find_movers(particle_set<D, R>& p, const team& t);
  void sort(particle_set<D, R>& p, const team& t);
  bool ascending(std::size_t begin, std::size_t end, const team& t) const;
  bool inside(const particle_set<D, R>& p, std::size_t begin, std::size_t end, const axes& along = axes::all(D)) const;
  /// Bits of a key below those of the kind.
  int cell_bits() const { return grid_->key_bits() + ghost_bits_; }
  void keys_of(particle_set<D, R>& p, std::size_t begin, std::size_t end, std::uint32_t* out, std::size_t& lost) const;

  box<D, R> omega_;
  std::unique_ptr<grid<D, R>> grid_;
  counting_sort counting_sort_;
  reorderer reorder_;
  merge_plan merge_;
  column<std::uint32_t> keys_;  ///< of all particles, as sorted: (kind, cell, ghost)
  std::vector<mover> movers_;
  cell_ranges<D> ranges_;
  bool known_ = false;
  int ghost_bits_ = 0;
  std::size_t fluid_ = 0, boundary_ = 0, lost_ = 0;
};

}  // namespace pairsum

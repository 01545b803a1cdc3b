#pragma once
#include <cstdint>
#include <span>

#include <pairsum/core/team.hpp>
#include <pairsum/grid/cell_scale.hpp>
#include <pairsum/grid/cells.hpp>
#include <pairsum/particles/particle_set.hpp>

namespace pairsum {

/// A grid: the key of a particle's cell, and which cells are neighbours. Everything else (sorting, ranges) belongs to
/// the indexer. A grid is called once per step and piece of the particles, so its virtual calls cost nothing.
template <int D, class R>
class grid {
 public:
  virtual ~grid() = default;

  /// Looks at the particles before keys(), for grids whose cells depend on them; those outside Omega and lost ones do
  /// not count. Only the first `moved` may be others than in the last call. Returns whether keys mean other cells than
  /// before: if not, particles that kept their cell keep their key.
  virtual bool adapt(const particle_set<D, R>&, [[maybe_unused]] std::size_t moved, const team&) { return false; }
  /// How it turns positions into coordinates of cells.
  virtual const cell_scale<D, R>& scale() const = 0;
  /// Number of cells, empty ones included, of a grid that has them; known after connect().
  virtual std::size_t total_cells() const = 0;
  /// Keys are below 2^key_bits() <= 2^30.
  virtual int key_bits() const = 0;
  /// Writes the cell keys of particles begin..end to out[0..]; that of a particle that is not in Omega does not matter.
  virtual void keys(const particle_set<D, R>& p, std::size_t begin, std::size_t end,
                    std::span<std::uint32_t> out) const = 0;
  /// Fills `neighbours` and `colour` for the fluid cells; cell_keys[c] is the key of cell c (entry 0 is unused).
  virtual void connect(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) = 0;
};

}  // namespace pairsum

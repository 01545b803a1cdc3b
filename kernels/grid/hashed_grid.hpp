#pragma once
#include <string_view>

#include <pairsum/grid/cell_scale.hpp>
#include <pairsum/grid/cell_table.hpp>
#include <pairsum/grid/grid.hpp>

namespace pairsum {

/// M, if dimension D (at least 1) can have it: 2 <= M and D M <= 30; else an error that says so.
int check_hash_size(int D, int M);

/// The talk's hashed grid: cell I = floor((x-A)/w) per component, folded to I mod 2^M, a torus of 2^(dM) cells.
/// Particles of cells that fold together share a cell; the distance test tells them apart. A periodic axis has a
/// multiple of 2^M cells, so that the torus closes where the axis does.
template <int D, class R>
class hashed_grid final : public grid<D, R> {
 public:
  static constexpr std::string_view name = "hashed_grid";

  /// omega: where particles may be (m). H: support radius (m). M: 2 <= M and D M <= 30, else an error that says so, as
  /// for a periodic box too small for it.
  hashed_grid(const box<D, R>& omega, R H, int M);

  const cell_scale<D, R>& scale() const override { return scale_; }
  std::size_t total_cells() const override { return table_.size(); }
  int key_bits() const override { return D * M_; }
  void keys(const particle_set<D, R>& p, std::size_t begin, std::size_t end,
            std::span<std::uint32_t> out) const override;
  void connect(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) override;

  /// Width w >= H of a cell: so much wider than H that two particles that pass the test r < H are never two cells
  /// apart, whatever the rounding of (x-A)/w.
  R cell_width(int d = 0) const { return scale_.w[d]; }

 private:
  static ivec<D> cells_round(const box<D, R>& omega, R H, int M);

  cell_scale<D, R> scale_;
  int M_;
  cell_table table_;
};

}  // namespace pairsum

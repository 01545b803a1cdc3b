#pragma once
#include <string_view>

#include <pairsum/grid/cell_box.hpp>
#include <pairsum/grid/cell_table.hpp>
#include <pairsum/grid/grid.hpp>

namespace pairsum {

/// A grid of all cells of the smallest box around the particles, as wide as those of the hashed grid and numbered x
/// fastest; no two cells fold together. The box follows the particles from step to step. A table over its cells finds
/// neighbours; only what is used of it takes memory, and a step costs only the cells that hold particles. Of a periodic
/// axis it has all cells.
template <int D, class R>
class dense_grid final : public grid<D, R> {
 public:
  static constexpr std::string_view name = "dense_grid";

  /// omega: where particles may be (m). H: support radius (m). Refuses an Omega so large that R does not resolve H.
  dense_grid(const box<D, R>& omega, R H);

  /// Refuses a box of more than 2^30 cells, or whose table is larger than the machine's memory, before anything is
  /// allocated.
  bool adapt(const particle_set<D, R>& p, std::size_t moved, const team& t) override;
  const cell_scale<D, R>& scale() const override { return scale_; }
  std::size_t total_cells() const override { return static_cast<std::size_t>(box_.cells()); }
  int key_bits() const override { return linear_.bits(); }
  void keys(const particle_set<D, R>& p, std::size_t begin, std::size_t end,
            std::span<std::uint32_t> out) const override {
    linear_.numbers_of(p, begin, end, scale_, out);
  }
  void connect(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) override;

  R cell_width(int d = 0) const { return scale_.w[d]; }

 private:
  box<D, R> omega_;
  cell_scale<D, R> scale_;
  box_follower<D, R> follower_;
  cell_box<D> box_;
  linear_cells<D> linear_;
  cell_table table_;
};

}  // namespace pairsum

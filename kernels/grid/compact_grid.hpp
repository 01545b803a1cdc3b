#pragma once
#include <string_view>
#include <vector>

#include <pairsum/grid/cell_box.hpp>
#include <pairsum/grid/cell_list.hpp>
#include <pairsum/grid/grid.hpp>

namespace pairsum {

/// A grid of the cells that hold particles and no others, as wide as those of the hashed grid and sorted x fastest; no
/// two cells fold together. Neighbours are found in the sorted list of cells, so neither time nor memory depends on how
/// large the domain is.
///
/// A cell's key is its number in the box around the particles, which has all cells of a periodic axis, while there are
/// at most 2^30, else its rank in the list; both ascend alike, so the order of the particles is the same.
template <int D, class R>
class compact_grid final : public grid<D, R> {
 public:
  static constexpr std::string_view name = "compact_grid";

  /// omega: where particles may be (m). H: support radius (m). Refuses an Omega so large that R does not resolve H.
  compact_grid(const box<D, R>& omega, R H);

  bool adapt(const particle_set<D, R>& p, std::size_t moved, const team& t) override;
  const cell_scale<D, R>& scale() const override { return scale_; }
  /// The cells that hold particles.
  std::size_t total_cells() const override { return total_; }
  int key_bits() const override;
  void keys(const particle_set<D, R>& p, std::size_t begin, std::size_t end,
            std::span<std::uint32_t> out) const override;
  void connect(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) override;

  R cell_width(int d = 0) const { return scale_.w[d]; }

 private:
  void connect_numbers(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t);
  void connect_list(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t);

  box<D, R> omega_;
  cell_scale<D, R> scale_;
  box_follower<D, R> follower_;
  cell_box<D> box_;
  linear_cells<D> linear_;
  cell_list<D, R> list_;                ///< used if the box is too large
  bool first_ = true, listed_ = false;  ///< listed: keys are ranks
  std::size_t total_ = 0;
  std::vector<std::uint32_t> keys_, number_;  ///< of all cells, by ascending key: the key, the cell
};

}  // namespace pairsum

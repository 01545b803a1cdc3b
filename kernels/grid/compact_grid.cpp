#include <pairsum/grid/compact_grid.hpp>

#include <bit>
#include <utility>

#include <pairsum/core/places.hpp>
#include <pairsum/grid/refusals.hpp>
#include <pairsum/grid/sorted_search.hpp>

namespace pairsum {

template <int D, class R>
compact_grid<D, R>::compact_grid(const box<D, R>& omega, R H)
    : omega_(omega), scale_(omega, H, check_periodic(omega, H)) {
  check_resolution(omega, H, name);
}

template <int D, class R>
bool compact_grid<D, R>::adapt(const particle_set<D, R>& p, std::size_t moved, const team& t) {
  const cell_box<D> now = follower_.fit(p, moved, omega_, scale_, t);
  const bool listed = linear_cells<D>::numbers(now, scale_.period) > static_cast<double>(linear_cells<D>::most);
  bool changed = std::exchange(first_, false) || listed != listed_;
  listed_ = listed;
  if (listed) {
    if (changed) list_ = {};
    changed |= list_.fit(p, moved, omega_, scale_, t);
  } else if (changed || now != box_) {
    changed = true;
    list_ = {};
    linear_ = linear_cells<D>(now, scale_.period);
  }
  box_ = now;
  return changed;
}

template <int D, class R>
int compact_grid<D, R>::key_bits() const {
  return listed_ ? std::bit_width(list_.places().size()) : linear_.bits();
}

template <int D, class R>
void compact_grid<D, R>::keys(const particle_set<D, R>& p, std::size_t begin, std::size_t end,
                              std::span<std::uint32_t> out) const {
  listed_ ? list_.ranks(p, begin, end, scale_, out) : linear_.numbers_of(p, begin, end, scale_, out);
}

template <int D, class R>
void compact_grid<D, R>::connect(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) {
  total_ = cell_keys.size() - 1;
  c.resize_fluid();
  // Cells with fluid and cells with boundary alone ascend each: one ascending list of both.
  keys_.resize(total_);
  number_.resize(total_);
  std::size_t fluid = 1, other = c.fluid_cells + 1;
  for (std::size_t k = 0; k < total_; ++k) {
    const bool take_fluid = other > total_ || (fluid <= c.fluid_cells && cell_keys[fluid] < cell_keys[other]);
    const std::size_t cell = take_fluid ? fluid++ : other++;
    keys_[k] = cell_keys[cell];
    number_[k] = static_cast<std::uint32_t>(cell);
  }
  listed_ ? connect_list(cell_keys, c, t) : connect_numbers(cell_keys, c, t);
}

template <int D, class R>
void compact_grid<D, R>::connect_numbers(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) {
  std::array<std::uint32_t, cells<D>::stencil / 3> step{};  // to the middle of a row, modulo 2^32
  for (unsigned row = 0; row < step.size(); ++row)
    for (unsigned d = 1, code = row; d < D; ++d, code /= 3)
      step[row] += (code % 3 - 1) * linear_.stride(static_cast<int>(d));
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t cell = begin + 1; cell <= end; ++cell) c.set_place(cell, linear_.place(cell_keys[cell]));
  });
  if (omega_.periodic.any())
    return connect_sorted_torus<D, std::uint32_t>(scale_.period, keys_, number_, c, t,
                                                  [&](const ivec<D>& at) { return linear_.number(at); });
  connect_sorted<D, std::uint32_t>(
      keys_, number_, c, t, [&](std::size_t cell) { return cell_keys[cell]; },
      [&](std::uint32_t key, int dx, unsigned row) { return key + step[row] + static_cast<std::uint32_t>(dx); });
}

template <int D, class R>
void compact_grid<D, R>::connect_list(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) {
  const auto places = list_.places();  // every one holds particles: place k belongs to key k
  const auto at = [&](std::size_t cell) { return places[cell_keys[cell]]; };
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t cell = begin + 1; cell <= end; ++cell) c.set_place(cell, at(cell).c);
  });
  if (omega_.periodic.any())
    return connect_sorted_torus<D, cell_place<D>>(scale_.period, places, number_, c, t,
                                                  [](const ivec<D>& at) { return cell_place<D>{at}; });
  connect_sorted<D, cell_place<D>>(places, number_, c, t, at, [](cell_place<D> place, int dx, unsigned row) {
    place.c[0] += dx;
    for (unsigned d = 1; d < D; ++d, row /= 3) place.c[d] += static_cast<std::int64_t>(row % 3) - 1;
    return place;
  });
}

#define PAIRSUM_COMPACT_GRID(D, R) template class compact_grid<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_COMPACT_GRID)

}  // namespace pairsum

#include <pairsum/grid/dense_grid.hpp>

#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/places.hpp>
#include <pairsum/grid/refusals.hpp>
#include <pairsum/grid/torus_table.hpp>

namespace pairsum {

template <int D, class R>
dense_grid<D, R>::dense_grid(const box<D, R>& omega, R H) : omega_(omega), scale_(omega, H, check_periodic(omega, H)) {
  check_resolution(omega, H, name);
}

template <int D, class R>
bool dense_grid<D, R>::adapt(const particle_set<D, R>& p, std::size_t moved, const team& t) {
  const cell_box<D> now = follower_.fit(p, moved, omega_, scale_, t);
  if (table_.size() > 0 && now == box_) return false;
  const double wanted = linear_cells<D>::numbers(now, scale_.period);
  if (wanted > static_cast<double>(linear_cells<D>::most))
    throw error("dense_grid would need " + number_text(wanted) + " cells (" + number_text(wanted * 4) +
                " bytes) for the " + now.text() + " cells of width " + number_text(static_cast<double>(scale_.w[0])) +
                (omega_.periodic == axes::all(D) ? " m of the periodic box" : " m around the particles") +
                ", at most 2^30 are possible; compact_grid works for any extent");
  const linear_cells<D> numbering(now, scale_.period);
  if (table_.size() < numbering.size())
    table_ = cell_table(zero_table(numbering.size(),
                                   ("dense_grid's table of " + std::to_string(numbering.size()) + " cells").c_str(),
                                   "compact_grid works for any extent"));
  box_ = now;
  linear_ = numbering;
  return true;
}

template <int D, class R>
void dense_grid<D, R>::connect(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) {
  table_.set(cell_keys, t);
  constexpr unsigned stencil = cells<D>::stencil;
  c.resize_fluid();
  if (omega_.periodic.any())
    return connect_torus<D>(
        scale_.period, table_.data(), c, t, [&](std::size_t cell) { return linear_.place(cell_keys[cell]); },
        [&](int d, std::int64_t a) { return linear_.part(d, a); });
  std::array<std::uint32_t, stencil> step{};  // from a cell's number to that of its neighbour, modulo 2^32
  for (unsigned n = 0; n < stencil; ++n)
    for (unsigned d = 0, code = n; d < D; ++d, code /= 3)
      step[n] += (code % 3 - 1) * linear_.stride(static_cast<int>(d));
  const std::uint32_t* const table = table_.data();
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t cell = begin + 1; cell <= end; ++cell) {
      c.set_place(cell, linear_.place(cell_keys[cell]));
      for (unsigned n = 0; n < stencil; ++n) c.neighbours[cell * stencil + n] = table[cell_keys[cell] + step[n]];
    }
  });
}

#define PAIRSUM_DENSE_GRID(D, R) template class dense_grid<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_DENSE_GRID)

}  // namespace pairsum

#include "grid/hashed_grid.hpp"

#include <array>
#include <string>

#include "core/error.hpp"

namespace pairsum {
int check_hash_size(int D, int M) {
  if (M >= 2 && M <= 30 / D) return M;
  const std::string range =
      "M must be between 2 and " + std::to_string(30 / D) + " in " + std::to_string(D) + "D, is " + std::to_string(M);
  throw error(M == 1 ? range + " (with M = 1 the neighbours -1 and +1 are one cell)" : range);
}

template <int D, class R>
hashed_grid<D, R>::hashed_grid(const box<D, R>& omega, R H, int M)
    : scale_(omega, H), M_(check_hash_size(D, M)), table_(zero_table(std::size_t{1} << (D * M_), "the hashed grid")) {}

template <int D, class R>
void hashed_grid<D, R>::keys(const particle_set<D, R>& p, std::size_t begin, std::size_t end,
                             std::span<std::uint32_t> out) const {
  const std::uint32_t mask = (std::uint32_t{1} << M_) - 1;
  std::array<const R*, D> x;
  for (int d = 0; d < D; ++d) x[d] = p.x[d].data();
  scale_.with_integer([&, to = out.data(), scale = scale_, M = M_](auto integer) {
    for (std::size_t i = begin; i < end; ++i) {
      std::uint32_t key = 0;
      for (int d = 0; d < D; ++d)
        key |= (static_cast<std::uint32_t>(scale.template cell<decltype(integer)>(d, x[d][i])) & mask) << (d * M);
      to[i - begin] = key;
    }
  });
}

template <int D, class R>
void hashed_grid<D, R>::connect(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) {
  table_.set(cell_keys, t);
  constexpr unsigned stencil = cells<D>::stencil;
  c.resize_fluid();
  c.period = std::int64_t{1} << M_;
  const std::uint32_t* const table = table_.data();
  const std::uint32_t mask = (std::uint32_t{1} << M_) - 1;
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t cell = begin + 1; cell <= end; ++cell) {
      // Per component the folded coordinates of the left, own and right cell, already shifted into place.
      std::array<std::array<std::uint32_t, 3>, D> part;
      ivec<D> place;
      for (int d = 0; d < D; ++d) {
        const std::uint32_t own = cell_keys[cell] >> (d * M_) & mask;
        place[d] = own;
        for (std::uint32_t o = 0; o < 3; ++o) part[d][o] = ((own + o - 1) & mask) << (d * M_);
      }
      c.set_place(cell, place);
      for (unsigned n = 0; n < stencil; ++n) {
        std::uint32_t key = 0;
        for (unsigned d = 0, code = n; d < D; ++d, code /= 3) key |= part[d][code % 3];
        c.neighbours[cell * stencil + n] = table[key];
      }
    }
  });
}

template class hashed_grid<1, double>;
template class hashed_grid<2, double>;
template class hashed_grid<3, double>;
template class hashed_grid<1, float>;
template class hashed_grid<2, float>;
template class hashed_grid<3, float>;

}  // namespace pairsum

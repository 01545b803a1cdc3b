#include "grid/hashed_grid.hpp"

#include <limits>
#include <string>

#include "core/error.hpp"

namespace pairsum {
namespace {

/// Smallest safe width. Computed coordinates t = (x-A)*(1/w) carry a relative error of at most 3u (subtraction,
/// reciprocal, product; u = half the machine epsilon), so two of them differ from the exact difference by at most 6u
/// t_max; a computed r < H means an exact distance below H (1 + 4u) per component. Hence w >= H (1 + 4u + 6u t_max),
/// doubled for safety.
template <int D, class R>
R safe_width(const box<D, R>& omega, R H) {
  const R u = std::numeric_limits<R>::epsilon() / 2;
  R t_max = 0;
  for (int d = 0; d < D; ++d) t_max = std::max(t_max, (omega.high[d] - omega.low[d]) / H);
  return H * (1 + 8 * u + 12 * u * t_max);
}

}  // namespace

int check_hash_size(int D, int M) {
  if (M >= 2 && M <= 30 / D) return M;
  const std::string range =
      "M must be between 2 and " + std::to_string(30 / D) + " in " + std::to_string(D) + "D, is " + std::to_string(M);
  throw error(M == 1 ? range + " (with M = 1 the neighbours -1 and +1 are one cell)" : range);
}

template <int D, class R>
hashed_grid<D, R>::hashed_grid(const box<D, R>& omega, R H, int M)
    : low_(omega.low),
      w_(safe_width(omega, H)),
      inv_w_(1 / w_),
      M_(check_hash_size(D, M)),
      table_(std::size_t{1} << (D * M_), "the hashed grid") {}

template <int D, class R>
void hashed_grid<D, R>::keys(const particle_set<D, R>& p, std::size_t begin, std::size_t end,
                             std::span<std::uint32_t> out) const {
  const std::int64_t mask = (std::int64_t{1} << M_) - 1;
  for (std::size_t i = begin; i < end; ++i) {
    std::uint32_t key = 0;
    for (int d = 0; d < D; ++d) {
      const R t = (p.x[d][i] - low_[d]) * inv_w_;
      const auto cell = static_cast<std::int64_t>(t >= 0 && t < R(0x1p62) ? t : R(0));  // NaN is 0
      key |= static_cast<std::uint32_t>(cell & mask) << (d * M_);
    }
    out[i] = key;
  }
}

template <int D, class R>
void hashed_grid<D, R>::mark(std::span<const std::uint32_t> cell_keys, bool present, const team& t) {
  t.for_pieces(cell_keys.size(), [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t c = std::max<std::size_t>(begin, 1); c < end; ++c)
      table_.data()[cell_keys[c]] = present ? static_cast<std::uint32_t>(c) : 0;
  });
}

template <int D, class R>
void hashed_grid<D, R>::connect(std::span<const std::uint32_t> cell_keys, cells<D>& c, const team& t) {
  mark(known_, false, t);
  known_.assign(cell_keys.begin(), cell_keys.end());
  mark(known_, true, t);
  constexpr unsigned stencil = cells<D>::stencil;
  c.neighbours.resize((c.fluid_cells + 1) * stencil);
  c.colour.resize(c.fluid_cells + 1);
  const std::uint32_t* const table = table_.data();
  const std::uint32_t mask = (std::uint32_t{1} << M_) - 1;
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t cell = begin + 1; cell <= end; ++cell) {
      // Per component the folded coordinates of the left, own and right cell, already shifted into place.
      std::array<std::array<std::uint32_t, 3>, D> part;
      std::uint8_t parity = 0;
      for (int d = 0; d < D; ++d) {
        const std::uint32_t own = cell_keys[cell] >> (d * M_) & mask;
        parity = static_cast<std::uint8_t>(parity | (own & 1u) << d);
        for (std::uint32_t o = 0; o < 3; ++o) part[d][o] = ((own + o - 1) & mask) << (d * M_);
      }
      c.colour[cell] = parity;
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

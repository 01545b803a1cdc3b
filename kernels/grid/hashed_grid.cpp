#include <pairsum/grid/hashed_grid.hpp>

#include <algorithm>
#include <array>
#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/core/places.hpp>
#include <pairsum/grid/refusals.hpp>
#include <pairsum/grid/torus_table.hpp>

namespace pairsum {
int check_hash_size(int D, int M) {
  if (M >= 2 && M <= 30 / D) return M;
  const std::string range =
      "M must be between 2 and " + std::to_string(30 / D) + " in " + std::to_string(D) + "D, is " + std::to_string(M);
  throw error(M == 1 ? range + " (with M = 1 the neighbours -1 and +1 are one cell)" : range);
}

template <int D, class R>
hashed_grid<D, R>::hashed_grid(const box<D, R>& omega, R H, int M)
    : scale_(omega, H, cells_round(omega, H, check_hash_size(D, M))),
      M_(M),
      table_(zero_table(std::size_t{1} << (D * M_), "the hashed grid")) {}

/// A periodic axis must close where the torus does.
template <int D, class R>
ivec<D> hashed_grid<D, R>::cells_round(const box<D, R>& omega, R H, int M) {
  const auto fits = [&](int m) { return goes_round(omega, H, std::int64_t{1} << m); };
  if (fits(M)) return torus_cells(omega, H, std::int64_t{1} << M);
  check_periodic(omega, H);
  if (!fits(2))
    throw error(
        "a hashed grid does not fit the periodic box of " + edges_text(omega, H) +
        " support radii: 4 cells or more must fit along each periodic axis, each as wide as the support radius " +
        "and what rounding takes; dense_grid and compact_grid take 3");
  int most = 2;
  while (most < M && fits(most + 1)) ++most;
  throw error("a hashed grid with M = " + std::to_string(M) + " does not fit the periodic box of " +
              edges_text(omega, H) + " support radii: " + std::to_string(1 << M) +
              " cells or a multiple must fit along each periodic axis, each as wide as the support radius and what "
              "rounding takes; " +
              (most > 2 ? "M from 2 to " + std::to_string(most) + " fit" : "M = 2 fits") +
              ", or a grid that takes no M");
}

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
  c.resize_fluid();
  const std::uint32_t mask = (std::uint32_t{1} << M_) - 1;
  ivec<D> period;
  period.fill(std::int64_t{1} << M_);
  connect_torus<D>(
      period, table_.data(), c, t,
      [&](std::size_t cell) {
        ivec<D> at;
        for (int d = 0; d < D; ++d) at[d] = cell_keys[cell] >> (d * M_) & mask;
        return at;
      },
      [&](int d, std::int64_t a) { return static_cast<std::uint32_t>(a) << (d * M_); });
}

#define PAIRSUM_HASHED_GRID(D, R) template class hashed_grid<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_HASHED_GRID)

}  // namespace pairsum

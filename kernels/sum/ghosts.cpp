#include <algorithm>
#include <vector>

#include <pairsum/core/error.hpp>
#include <pairsum/core/places.hpp>
#include <pairsum/sum/ghosts.hpp>

namespace pairsum {

template <int D>
void ghost_marks::mark(const cells<D>& c, std::size_t fluid, const team& t) {
  before.resize(fluid + 1);
  before[0] = 0;
  for (std::size_t k = 0; k < fluid; ++k) before[k + 1] = before[k] + (kind[k] == particle_kind::ghost);
  near.resize(c.fluid_cells + 1);
  if (before.back() == 0) return;
  std::vector<std::uint8_t> sorted(static_cast<std::size_t>(t.threads()), 1);
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t piece) {
    for (std::size_t cell = begin + 1; cell <= end; ++cell) {
      std::uint32_t around = 0;
      for (unsigned n = 0; n < cells<D>::stencil; ++n) around |= ghosts_in(c.range[c.neighbour(cell, n)].fluid);
      near[cell] = around != 0;
      const index_range& own = c.range[cell].fluid;
      for (std::uint32_t k = own.begin + 1; around != 0 && k < own.end; ++k)
        if (is_ghost(k - 1) && !is_ghost(k)) sorted[piece] = 0;
    }
  });
  if (std::ranges::count(sorted, 0) > 0) throw error("a cell has ghosts before its own fluid");
}

#define PAIRSUM_MARKS(D) template void ghost_marks::mark(const cells<D>&, std::size_t, const team&);
PAIRSUM_EACH_D(PAIRSUM_MARKS)

}  // namespace pairsum

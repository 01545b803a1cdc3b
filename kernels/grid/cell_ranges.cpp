#include <pairsum/grid/cell_ranges.hpp>

#include <pairsum/grid/grid.hpp>

namespace pairsum {
namespace {

/// Writes the indices in [begin, end) at which a new key starts, whatever its lower bits.
void find_starts(std::span<const std::uint32_t> keys, int lower_bits, std::size_t begin, std::size_t end,
                 column<std::uint32_t>& result, const team& t) {
  const auto differ = [&](std::size_t k) { return (keys[k - 1] ^ keys[k]) >> lower_bits != 0; };
  const auto is_start = [&](std::size_t k) { return k == begin || differ(k); };
  std::vector<std::size_t> offset(static_cast<std::size_t>(t.threads()) + 1, 0);
  t.for_pieces(end - begin, [&](std::size_t b, std::size_t e, std::size_t piece) {
    if (b == e) return;
    std::size_t n = is_start(begin + b);
    for (std::size_t k = begin + b + 1; k < begin + e; ++k) n += differ(k);
    offset[piece + 1] = n;
  });
  for (std::size_t piece = 1; piece < offset.size(); ++piece) offset[piece] += offset[piece - 1];
  result.resize(offset.back());
  t.for_pieces(end - begin, [&](std::size_t b, std::size_t e, std::size_t piece) {
    std::size_t n = offset[piece];
    for (std::size_t k = begin + b; n < offset[piece + 1] && k < begin + e; ++k) {
      result[n] = static_cast<std::uint32_t>(k);  // without a branch; the next start overwrites what is none
      n += is_start(k);
    }
  });
}

}  // namespace

template <int D>
void cell_ranges<D>::find_cells(std::span<const std::uint32_t> keys, int lower_bits, std::size_t fluid,
                                std::size_t boundary, std::uint32_t cell_mask, const team& t) {
  auto end_of = [](const column<std::uint32_t>& s, std::size_t k, std::size_t end) {
    return k + 1 < s.size() ? s[k + 1] : static_cast<std::uint32_t>(end);
  };
  const std::size_t n = fluid_starts_.size();
  cells_.fluid_cells = n;
  cells_.range.resize(n + 1);
  cells_.range[0] = {};
  cell_keys_.assign(n + 1, 0);
  t.for_pieces(n, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k) {
      cells_.range[k + 1] = {fluid_starts_[k], end_of(fluid_starts_, k, fluid), 0, 0};
      cell_keys_[k + 1] = keys[fluid_starts_[k]] >> lower_bits;
    }
  });
  std::size_t c = 1;  // walks the fluid cells in step with the boundary cells: both ascend by key
  for (std::size_t k = 0; k < boundary_starts_.size(); ++k) {
    const std::uint32_t begin = boundary_starts_[k], end = end_of(boundary_starts_, k, fluid + boundary);
    const std::uint32_t key = keys[begin] >> lower_bits & cell_mask;
    while (c <= n && cell_keys_[c] < key) ++c;
    if (c <= n && cell_keys_[c] == key) {
      cells_.range[c].boundary.begin = begin;
      cells_.range[c].boundary.end = end;
    } else {
      cells_.range.push_back({{0, 0}, {begin, end}});
      cell_keys_.push_back(key);
    }
  }
}

template <int D>
template <class R>
void cell_ranges<D>::make(std::span<const std::uint32_t> keys, int lower_bits, std::size_t fluid, std::size_t boundary,
                          bool boundary_kept, bool renumbered, grid<D, R>& g, const team& t) {
  find_starts(keys, lower_bits, 0, fluid, fluid_starts_, t);
  if (!boundary_kept) find_starts(keys, lower_bits, fluid, fluid + boundary, boundary_starts_, t);
  std::swap(cell_keys_, last_keys_);
  find_cells(keys, lower_bits, fluid, boundary, (std::uint32_t{1} << g.key_bits()) - 1, t);
  if (!renumbered && last_fluid_cells_ == cells_.fluid_cells && cell_keys_ == last_keys_) return;
  last_fluid_cells_ = cells_.fluid_cells;
  ++cells_.revision;
  for (int d = 0; d < D; ++d) {
    cells_.low[d] = static_cast<double>(g.scale().low[d]);
    cells_.per_metre[d] = static_cast<double>(g.scale().inv_w[d]);
  }
  g.connect(cell_keys_, cells_, t);
  cells_.total = g.total_cells();
}

#define PAIRSUM_CELL_RANGES(D, R)                                                                                  \
  template void cell_ranges<D>::make<R>(std::span<const std::uint32_t>, int, std::size_t, std::size_t, bool, bool, \
                                        grid<D, R>&, const team&);
#define PAIRSUM_ALL_CELL_RANGES(D) \
  template class cell_ranges<D>;   \
  PAIRSUM_CELL_RANGES(D, double)   \
  PAIRSUM_CELL_RANGES(D, float)
PAIRSUM_ALL_CELL_RANGES(1)
PAIRSUM_ALL_CELL_RANGES(2)
PAIRSUM_ALL_CELL_RANGES(3)
#undef PAIRSUM_ALL_CELL_RANGES
#undef PAIRSUM_CELL_RANGES

}  // namespace pairsum

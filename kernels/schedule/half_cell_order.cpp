#include <pairsum/core/places.hpp>
#include <pairsum/schedule/half_cell_order.hpp>

#include <cmath>

namespace pairsum {
namespace {

/// Is the cell after `cell` its next along the first axis?
template <int D>
bool goes_on(const cells<D>& c, std::size_t cell) {
  ivec<D> next = c.place[cell];
  ++next[0];
  return cell < c.fluid_cells && c.place[cell + 1] == next;
}

}  // namespace

/// Sorts the particles, of one kind, of cells first..end-1, which follow each other in memory: by row of half cells,
/// then along the row. `kind`: the member of cell_range that says where they are.
template <int D, class R>
void half_cell_order<D, R>::sort_run(const cells<D>& c, std::size_t first, std::size_t end,
                                     index_range cell_range::*kind) {
  const auto each = [&](auto&& f) {
    for (std::size_t cell = first; cell < end; ++cell) {
      const index_range& own = c.range[cell].*kind;
      for (std::uint32_t i = own.begin; i < own.end; ++i) f(i, (range_[cell * parts + part_[i]].*kind).end);
    }
  };
  std::size_t filled = first;
  while (filled + 1 < end && (c.range[filled].*kind).empty()) ++filled;
  std::uint32_t next = (c.range[filled].*kind).begin;
  for (std::size_t at = first * parts; at < end * parts; ++at) (range_[at].*kind).end = 0;
  each([](std::uint32_t, std::uint32_t& count) { ++count; });
  for (unsigned row = 0; row < parts; row += 2)
    for (std::size_t cell = first; cell < end; ++cell)
      for (unsigned part = row; part < row + 2; ++part) {
        index_range& own = range_[cell * parts + part].*kind;
        const std::uint32_t count = own.end;
        own.begin = own.end = next;
        next += count;
      }
  each([&](std::uint32_t i, std::uint32_t& to) { order_[to++] = i; });
}

template <int D, class R>
void half_cell_order<D, R>::build(const search_space<D, R>& space, const cells<D>& c, std::size_t count,
                                  const team& t) {
  const positions<D, R>& x = space.x;
  order_.resize(count + place_room);
  part_.resize(count);
  for (auto& column : x_) column.resize(count);
  range_.resize(c.range.size() * parts);
  for (unsigned part = 0; part < parts; ++part) range_[part] = {};
  vec<D, R> low, per_metre;
  for (int d = 0; d < D; ++d) {
    low[d] = static_cast<R>(c.low[d]);
    per_metre[d] = static_cast<R>(c.per_metre[d]);
  }
  t.for_pieces(count, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      unsigned part = 0;
      for (int d = 0; d < D; ++d) {
        const R at = (x.column[d][i] - low[d]) * per_metre[d];  // as the grid has it: parts lie within their cells
        part |= static_cast<unsigned>(at - std::floor(at) >= R(0.5)) << d;
      }
      part_[i] = static_cast<std::uint8_t>(part);
    }
  });
  const auto sort = [&](std::size_t first, std::size_t end) {
    sort_run(c, first, end, &cell_range::fluid);
    sort_run(c, first, end, &cell_range::boundary);
  };
  t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t cell = begin + 1; cell <= end;) {  // the runs that begin in the piece
      const std::size_t first = cell;
      const bool begins = first == 1 || !goes_on(c, first - 1);
      while (goes_on(c, cell)) ++cell;
      ++cell;
      if (begins) sort(first, cell);
    }
  });
  for (std::size_t cell = c.fluid_cells + 1; cell < c.range.size(); ++cell) sort(cell, cell + 1);
  t.for_pieces(count, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (int d = 0; d < D; ++d)
      for (std::size_t k = begin; k < end; ++k) x_[d][k] = x.column[d][order_[k]];
  });
  if (space.places.place[0] == nullptr) return;
  for (auto& column : place_) column.resize(count + place_room);
  t.for_pieces(count, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (int d = 0; d < D; ++d)
      for (std::size_t k = begin; k < end; ++k) place_[d][k] = space.places.place[d][order_[k]];
  });
}

#define PAIRSUM_HALF_CELL_ORDER(D, R) template class half_cell_order<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_HALF_CELL_ORDER)

}  // namespace pairsum

#include "sum/half_cell_order.hpp"

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
/// then along the row. begin_of and end_of: the members of cell_range that say where they are.
template <int D, class R>
template <class Begin, class End>
void half_cell_order<D, R>::sort_run(const cells<D>& c, std::size_t first, std::size_t end, Begin begin_of,
                                     End end_of) {
  const auto each = [&](auto&& f) {
    for (std::size_t cell = first; cell < end; ++cell)
      for (std::uint32_t i = c.range[cell].*begin_of; i < c.range[cell].*end_of; ++i)
        f(i, range_[cell * parts + part_[i]].*end_of);
  };
  std::size_t filled = first;
  while (filled + 1 < end && c.range[filled].*begin_of == c.range[filled].*end_of) ++filled;
  std::uint32_t next = c.range[filled].*begin_of;
  for (std::size_t at = first * parts; at < end * parts; ++at) range_[at].*end_of = 0;
  each([](std::uint32_t, std::uint32_t& count) { ++count; });
  for (unsigned row = 0; row < parts; row += 2)
    for (std::size_t cell = first; cell < end; ++cell)
      for (unsigned part = row; part < row + 2; ++part) {
        cell_range& own = range_[cell * parts + part];
        const std::uint32_t count = own.*end_of;
        own.*begin_of = own.*end_of = next;
        next += count;
      }
  each([&](std::uint32_t i, std::uint32_t& to) { order_[to++] = i; });
}

template <int D, class R>
void half_cell_order<D, R>::build(const positions<D, R>& x, const cells<D>& c, std::size_t count, const team& t) {
  order_.resize(count);
  omega_ = x.omega;
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
    sort_run(c, first, end, &cell_range::fluid_begin, &cell_range::fluid_end);
    sort_run(c, first, end, &cell_range::boundary_begin, &cell_range::boundary_end);
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
}

template class half_cell_order<1, double>;
template class half_cell_order<2, double>;
template class half_cell_order<3, double>;
template class half_cell_order<1, float>;
template class half_cell_order<2, float>;
template class half_cell_order<3, float>;

}  // namespace pairsum

#pragma once
#include <array>

#include <pairsum/grid/cells.hpp>
#include <pairsum/sum/work_counts.hpp>

namespace pairsum {

/// Up to `Capacity` ranges on the stack; ranges that touch are merged, so that cells in a row become one long range.
template <unsigned Capacity>
class range_list {
 public:
  void clear() { n_ = 0; }
  void add(const index_range& r) {
    if (r.empty()) return;
    if (n_ > 0 && ranges_[n_ - 1].end == r.begin)
      ranges_[n_ - 1].end = r.end;
    else
      ranges_[n_++] = r;
  }
  const index_range* begin() const { return ranges_.data(); }
  const index_range* end() const { return ranges_.data() + n_; }
  bool empty() const { return n_ == 0; }
  std::size_t size() const {
    std::size_t n = 0;
    for (unsigned k = 0; k < n_; ++k) n += ranges_[k].end - ranges_[k].begin;
    return n;
  }

 private:
  std::array<index_range, Capacity> ranges_;
  unsigned n_ = 0;
};

/// Which fluid candidates a particle of a meeting meets.
enum class partners {
  all,     ///< all; it is not among them
  later,   ///< those after it; the first range begins with the particles of the meeting themselves
  others,  ///< all but itself; only its own side is summed (the gather)
};

/// The unit of a sum: fluid particles [begin, end), each against candidates of `fluid` and `boundary`; the talk's sumF1
/// and sumF2 of a cell.
template <int D>
struct meeting {
  std::uint32_t begin = 0, end = 0;
  partners who = partners::all;
  range_list<pattern::stencil_cells<D> + 1> fluid, boundary;

  bool empty() const { return begin == end || (fluid.empty() && boundary.empty()); }
  /// Starts over with the particles of a cell, which `later` meet each other, too.
  [[gnu::always_inline]] void start(const cell_range& own, partners with) {
    begin = own.fluid.begin;
    end = own.fluid.end;
    who = with;
    fluid.clear();
    boundary.clear();
    if (with == partners::later) fluid.add(own.fluid);
  }
};

/// A cell against itself and its (3^d - 1)/2 forward neighbours, and against the boundary of all neighbours (no
/// loop starts from a boundary cell, so neighbours on both sides are taken here). `counts`: nullptr when timed.
template <int D>
[[gnu::always_inline]] inline meeting<D> half_stencil(const cells<D>& c, std::size_t cell, work_counts* counts) {
  constexpr unsigned centre = pattern::stencil_centre<D>;
  meeting<D> m;
  m.start(c.range[cell], partners::later);
  for (unsigned n = 0; n < cells<D>::stencil; ++n) {
    const cell_range& other = c.range[c.neighbour(cell, n)];
    m.boundary.add(other.boundary);
    if (n > centre) m.fluid.add(other.fluid);
  }
  if (counts != nullptr) [[unlikely]] {
    ++counts->sumF1;
    for (unsigned n = 0; n < cells<D>::stencil;
         ++n)  // a backward neighbour without fluid does not open the pair itself
      counts->sumF2 +=
          n != centre && c.neighbour(cell, n) != 0 && (n > centre || c.range[c.neighbour(cell, n)].fluid.size() == 0);
  }
  return m;
}

/// The gather: a cell against all cells around it.
template <int D>
[[gnu::always_inline]] inline meeting<D> full_stencil(const cells<D>& c, std::size_t cell) {
  meeting<D> m;
  m.start(c.range[cell], partners::others);
  for (unsigned n = 0; n < cells<D>::stencil; ++n) {
    const cell_range& other = c.range[c.neighbour(cell, n)];
    m.fluid.add(other.fluid);
    m.boundary.add(other.boundary);
  }
  return m;
}

}  // namespace pairsum

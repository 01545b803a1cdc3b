#pragma once
#include <vector>

#include <pairsum/grid/cells.hpp>
#include <pairsum/pattern/axis_colours.hpp>

namespace pairsum {

/// The cells with fluid by the colours of the half stencil. The cells that a half-stencil sweep of a cell writes to are
/// one more on either side of it along every axis but the slowest, and one more ahead along the slowest:
///
///     . ^ ^ ^      so cells of a colour are 3 apart along the fast axes and 2 along the slowest:
///     . . B >      3^(d-1) 2 colours, 18 in 3D, and more where a torus has a seam (pattern/axis_colours.hpp)
///
/// The same lists for every team.
template <int D>
class coloured_cells {
 public:
  /// Does nothing if the cells are those of the last call.
  void build(const cells<D>& c) {
    if (c.revision == revision_ && revision_ != 0) return;
    std::array<unsigned, D> stride{};
    unsigned colours = 1;
    for (int d = 0; d < D; ++d) {
      stride[d] = colours;
      colours *= pattern::axis_colours(c.period[d], spacing(d));
    }
    by_colour_.resize(colours);
    for (auto& list : by_colour_) list.clear();
    for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
      unsigned colour = 0;
      for (int d = 0; d < D; ++d) colour += stride[d] * pattern::axis_colour(c.place[cell][d], c.period[d], spacing(d));
      by_colour_[colour].push_back(static_cast<std::uint32_t>(cell));
    }
    std::erase_if(by_colour_, [](const auto& list) { return list.empty(); });
    revision_ = c.revision;
  }

  /// Colours that have cells.
  unsigned colours() const { return static_cast<unsigned>(by_colour_.size()); }
  const std::vector<std::uint32_t>& operator[](unsigned colour) const { return by_colour_[colour]; }

 private:
  static constexpr std::int64_t spacing(int d) { return d == D - 1 ? 2 : 3; }

  std::vector<std::vector<std::uint32_t>> by_colour_;
  std::uint64_t revision_ = 0;
};

}  // namespace pairsum

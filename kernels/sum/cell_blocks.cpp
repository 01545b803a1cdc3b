#include "sum/cell_blocks.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>

#include "core/error.hpp"

namespace pairsum {
namespace {

template <int D>
struct hash {
  std::size_t operator()(const ivec<D>& v) const {
    std::uint64_t h = 0;
    for (const std::int64_t a : v) h = (h ^ static_cast<std::uint64_t>(a)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(h ^ h >> 32);
  }
};

}  // namespace

template <int D>
void cell_blocks<D>::build(const cells<D>& c) {
  const int axes = std::min(shape_.axes, D);
  // On a torus of 2^M cells the blocks must be as wide each, and their colours must alternate all the way round.
  std::int64_t width = shape_.width;
  if (shape_.adapts && c.period > 0) width = std::min(width, c.period / 2);
  if (!one_pass_ && c.period % (2 * width) != 0)
    throw error("blocks of " + std::to_string(width) + " cells do not go round a torus of " + std::to_string(c.period) +
                " cells in two colours: take a power of two up to " + std::to_string(c.period / 2) +
                ", or a grid that takes no M");
  // Blocks are numbered as they are met in the order of the grid.
  struct found {
    unsigned colour;
    std::uint32_t cells, next;
  };
  std::vector<found> blocks;
  std::unordered_map<ivec<D>, std::uint32_t, hash<D>> number;
  block_.resize(c.fluid_cells + 1);
  ivec<D> last{};
  std::uint32_t last_number = 0;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    ivec<D> at{};
    for (int d = D - axes; d < D; ++d) at[d] = c.place[cell][d] / width;
    if (cell == 1 || at != last) {
      const auto [entry, is_new] = number.try_emplace(at, static_cast<std::uint32_t>(blocks.size()));
      if (is_new) {
        unsigned colour = 0;
        for (int d = 0; d < axes && !one_pass_; ++d) colour |= static_cast<unsigned>(at[D - axes + d] & 1) << d;
        blocks.push_back({colour, 0, 0});
      }
      last = at;
      last_number = entry->second;
    }
    ++blocks[last_number].cells;
    block_[cell] = last_number;
  }
  begin_.assign(one_pass_ ? 1 : std::size_t{1} << axes, {});
  std::uint32_t position = 0;
  for (unsigned colour = 0; colour < begin_.size(); ++colour) {
    for (found& b : blocks)
      if (b.colour == colour) {
        begin_[colour].push_back(position);
        b.next = position;
        position += b.cells;
      }
    begin_[colour].push_back(position);
  }
  order_.resize(c.fluid_cells);
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
    order_[blocks[block_[cell]].next++] = static_cast<std::uint32_t>(cell);
}

template class cell_blocks<1>;
template class cell_blocks<2>;
template class cell_blocks<3>;

}  // namespace pairsum

#include <pairsum/schedule/cell_blocks.hpp>

#include <algorithm>
#include <string>
#include <unordered_map>

#include <pairsum/core/error.hpp>
#include <pairsum/core/places.hpp>
#include <pairsum/grid/place_hash.hpp>
#include <pairsum/schedule/block_cut.hpp>

namespace pairsum {

template <int D>
bool cell_blocks<D>::build(const cells<D>& c) {
  const auto end = c.place.begin() + static_cast<std::ptrdiff_t>(c.fluid_cells) + 1;
  if (c.period == period_ && c.fluid_cells + 1 == place_.size() &&
      std::equal(c.place.begin() + 1, end, place_.begin() + 1))
    return false;
  place_.clear();  // until all is done
  if (limits_) shape_ = choose_block(c, *limits_);
  const int axes = std::min(shape_.axes, D);
  // On a torus colours must alternate all the way round.
  for (int d = D - axes; d < D && !one_pass_; ++d)
    if (!block_cut(shape_.width, c.period[d]).fits())
      throw error("blocks of " + std::to_string(shape_.width) + " cells do not fit around a torus of " +
                  std::to_string(c.period[d]) + " cells in two colours: they may be up to " +
                  std::to_string(c.period[d] / 2) + " cells wide");
  find_blocks(c, axes);
  begin_.assign(one_pass_ ? 1 : std::size_t{1} << axes, {});
  std::uint32_t position = 0;
  for (unsigned colour = 0; colour < begin_.size(); ++colour) {
    for (block& b : blocks_)
      if (b.colour == colour) {
        begin_[colour].push_back(position);
        b.next = position;
        position += b.cells;
      }
    begin_[colour].push_back(position);
  }
  order_.resize(c.fluid_cells);
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
    order_[blocks_[block_of_[cell]].next++] = static_cast<std::uint32_t>(cell);
  place_.assign(c.place.begin(), end);
  period_ = c.period;
  return true;
}

/// Blocks are numbered as they are met in the order of the grid.
template <int D>
void cell_blocks<D>::find_blocks(const cells<D>& c, int axes) {
  std::unordered_map<ivec<D>, std::uint32_t, place_hash<D>> known;
  blocks_.clear();
  block_of_.resize(c.fluid_cells + 1);
  ivec<D> last{};
  std::uint32_t number = 0;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    ivec<D> at{};
    for (int d = D - axes; d < D; ++d)
      at[d] = block_cut(shape_.width, one_pass_ ? 0 : c.period[d]).block_of(c.place[cell][d]);
    if (cell == 1 || at != last) {
      const auto [entry, is_new] = known.try_emplace(at, static_cast<std::uint32_t>(blocks_.size()));
      if (is_new) {
        unsigned colour = 0;
        for (int d = 0; d < axes && !one_pass_; ++d) colour |= static_cast<unsigned>(at[D - axes + d] & 1) << d;
        blocks_.push_back({colour, 0, 0});
      }
      last = at;
      number = entry->second;
    }
    ++blocks_[number].cells;
    block_of_[cell] = number;
  }
}

#define PAIRSUM_CELL_BLOCKS(D) template class cell_blocks<D>;
PAIRSUM_EACH_D(PAIRSUM_CELL_BLOCKS)

}  // namespace pairsum

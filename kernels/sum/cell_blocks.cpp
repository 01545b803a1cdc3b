#include "sum/cell_blocks.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <unordered_map>

#include "core/error.hpp"
#include "grid/place_hash.hpp"
#include "sum/block_cut.hpp"

namespace pairsum {
namespace {

template <int D>
using numbers = std::unordered_map<ivec<D>, std::uint32_t, place_hash<D>>;

/// Bits of the coordinates in turns, the first axis' lowest.
template <int D>
std::uint64_t morton_code(const ivec<D>& at) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < 64 / D; ++bit)
    for (int d = 0; d < D; ++d) code |= (static_cast<std::uint64_t>(at[d]) >> bit & 1) << (bit * D + d);
  return code;
}

}  // namespace

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
      throw error("blocks of " + std::to_string(shape_.width) + " cells do not go round a torus of " +
                  std::to_string(c.period[d]) + " cells in two colours: they may be up to " +
                  std::to_string(c.period[d] / 2) + " wide");
  find_strands(c, axes);
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
  for (strand& s : strands_) {
    s.next = blocks_[s.block].next;
    blocks_[s.block].next += s.cells;
  }
  place_in_order(c);
  place_.assign(c.place.begin(), end);
  period_ = c.period;
  return true;
}

/// Blocks and the strands that make them are numbered as they are met in the order of the grid.
template <int D>
void cell_blocks<D>::find_strands(const cells<D>& c, int axes) {
  numbers<D> strand_at, block_at;
  blocks_.clear();
  strands_.clear();
  strand_of_.resize(c.fluid_cells + 1);
  const bool bundled = shape_.order == cell_order::bundles;
  ivec<D> last{};
  std::uint32_t number = 0;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    const ivec<D>& at = c.place[cell];
    ivec<D> in_block{}, in_strand{};
    for (int d = 0; d < D; ++d) {
      const bool is_cut = d >= D - axes;
      const block_cut cut(shape_.width, one_pass_ ? 0 : c.period[d]);
      in_block[d] = is_cut ? cut.block_of(at[d]) : 0;
      in_strand[d] = in_block[d];
      if (bundled && d > 0) {
        const std::int64_t first = is_cut ? cut.first_of(in_block[d]) : 0;
        in_strand[d] = first + (at[d] - first) / 2;
      }
    }
    if (cell == 1 || in_strand != last) {
      const auto [entry, is_new] = strand_at.try_emplace(in_strand, static_cast<std::uint32_t>(strands_.size()));
      if (is_new) {
        const auto [own, opens] = block_at.try_emplace(in_block, static_cast<std::uint32_t>(blocks_.size()));
        unsigned colour = 0;
        for (int d = 0; d < axes && !one_pass_; ++d) colour |= static_cast<unsigned>(in_block[D - axes + d] & 1) << d;
        if (opens) blocks_.push_back({colour, 0, 0});
        strands_.push_back({own->second, 0, 0});
      }
      last = in_strand;
      number = entry->second;
    }
    ++strands_[number].cells;
    ++blocks_[strands_[number].block].cells;
    strand_of_[cell] = number;
  }
}

template <int D>
void cell_blocks<D>::place_in_order(const cells<D>& c) {
  order_.resize(c.fluid_cells);
  const auto place = [&](std::size_t cell) {
    order_[strands_[strand_of_[cell]].next++] = static_cast<std::uint32_t>(cell);
  };
  if (shape_.order == cell_order::bundles && D > 1) {
    for (const std::uint32_t cell : along_first_axis(c)) place(cell);
  } else {
    for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) place(cell);
  }
  if (shape_.order == cell_order::morton) {
    ivec<D> corner = c.fluid_cells > 0 ? c.place[1] : ivec<D>{};
    for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
      for (int d = 0; d < D; ++d) corner[d] = std::min(corner[d], c.place[cell][d]);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> coded;
    for (const auto& blocks : begin_)
      for (std::size_t b = 0; b + 1 < blocks.size(); ++b) {
        coded.clear();
        for (std::uint32_t k = blocks[b]; k < blocks[b + 1]; ++k) {
          ivec<D> at = c.place[order_[k]];
          for (int d = 0; d < D; ++d) at[d] -= corner[d];
          coded.emplace_back(morton_code<D>(at), order_[k]);
        }
        std::ranges::sort(coded);
        for (std::size_t k = 0; k < coded.size(); ++k) order_[blocks[b] + k] = coded[k].second;
      }
  }
}

/// The cells by their first coordinate, among equals as the grid has them.
template <int D>
std::vector<std::uint32_t> cell_blocks<D>::along_first_axis(const cells<D>& c) {
  std::vector<std::uint32_t> along(c.fluid_cells);
  if (along.empty()) return along;
  std::int64_t least = c.place[1][0], most = least;
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) {
    least = std::min<std::int64_t>(least, c.place[cell][0]);
    most = std::max<std::int64_t>(most, c.place[cell][0]);
  }
  if (static_cast<std::uint64_t>(most - least) > 4 * c.fluid_cells) {  // few cells in a wide world
    std::iota(along.begin(), along.end(), 1);
    std::ranges::stable_sort(along, {}, [&](std::uint32_t cell) { return c.place[cell][0]; });
    return along;
  }
  std::vector<std::uint32_t> begin(static_cast<std::size_t>(most - least) + 2);
  const auto slot = [&](std::size_t cell) { return static_cast<std::size_t>(c.place[cell][0] - least); };
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) ++begin[slot(cell) + 1];
  for (std::size_t x = 1; x < begin.size(); ++x) begin[x] += begin[x - 1];
  for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
    along[begin[slot(cell)]++] = static_cast<std::uint32_t>(cell);
  return along;
}

template class cell_blocks<1>;
template class cell_blocks<2>;
template class cell_blocks<3>;

}  // namespace pairsum

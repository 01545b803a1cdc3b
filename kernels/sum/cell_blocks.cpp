#include "sum/cell_blocks.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <unordered_map>

#include "core/error.hpp"

namespace pairsum {
namespace {

constexpr std::array<std::string_view, 3> shape_names{"slab", "pencil", "brick"};
constexpr int widest = 4096;

template <int D>
struct hash {
  std::size_t operator()(const ivec<D>& v) const {
    std::uint64_t h = 0;
    for (const std::int64_t a : v) h = (h ^ static_cast<std::uint64_t>(a)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(h ^ h >> 32);
  }
};

}  // namespace

block_shape block_shape::parse(const std::string& word) {
  const std::size_t colon = word.find(':');
  const auto name = std::ranges::find(shape_names, word.substr(0, colon));
  int width = 0;
  if (name != shape_names.end() && colon != std::string::npos) {
    const char *begin = word.data() + colon + 1, *end = word.data() + word.size();
    const auto [at, failed] = std::from_chars(begin, end, width);
    if (failed != std::errc() || at != end) width = 0;
  }
  if (width < 2 || width > widest)
    throw error("block must be auto, slab:N, pencil:N or brick:N with N from 2 to " + std::to_string(widest) +
                " cells, is \"" + word + "\"");
  return {static_cast<int>(name - shape_names.begin()) + 1, width};
}

block_shape block_shape::fitting(int dim, std::size_t cache_bytes, std::size_t bytes_per_cell) {
  const std::size_t room = (cache_bytes > 0 ? cache_bytes : std::size_t{1} << 20) / 2 / bytes_per_cell;
  int width = 2;
  const auto touched = [&](int w) {
    std::size_t n = 1;
    for (int d = 0; d < dim; ++d) n *= static_cast<std::size_t>(w + 2);
    return n;
  };
  while (width < 16 && touched(2 * width) <= room) width *= 2;
  return {3, width};
}

void check_block(const std::string& word) {
  if (word != "auto") block_shape::parse(word);
}

template <int D>
void cell_blocks<D>::build(const cells<D>& c) {
  const int axes = std::min(shape_.axes, D);
  std::array<std::int64_t, D> width{};
  for (int d = D - axes; d < D; ++d) {
    width[d] = shape_.width;
    // A torus of 2^M cells: its blocks must be as wide each, and their colours must alternate all the way round.
    if (c.period > 0 && c.period % (2 * shape_.width) != 0)
      throw error("blocks of " + std::to_string(shape_.width) + " cells do not go round a torus of " +
                  std::to_string(c.period) + " cells in two colours: take a power of two up to " +
                  std::to_string(c.period / 2) + ", or a grid that takes no M");
  }
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
    for (int d = D - axes; d < D; ++d) at[d] = c.place[cell][d] / width[d];
    if (cell == 1 || at != last) {
      const auto [entry, is_new] = number.try_emplace(at, static_cast<std::uint32_t>(blocks.size()));
      if (is_new) {
        unsigned colour = 0;
        for (int d = 0; d < axes; ++d) colour |= static_cast<unsigned>(at[D - axes + d] & 1) << d;
        blocks.push_back({colour, 0, 0});
      }
      last = at;
      last_number = entry->second;
    }
    ++blocks[last_number].cells;
    block_[cell] = last_number;
  }
  begin_.assign(std::size_t{1} << axes, {});
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

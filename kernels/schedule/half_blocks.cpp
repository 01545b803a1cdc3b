#include <pairsum/schedule/half_blocks.hpp>

#include <limits>
#include <string>
#include <utility>

#include <pairsum/core/error.hpp>
#include <pairsum/core/places.hpp>

namespace pairsum {

template <int D>
void half_blocks<D>::build(const cells<D>& c, const team& t) {
  if (c.revision == revision_ && revision_ != 0) return;
  revision_ = 0;
  std::array<unsigned, D> stride{};
  unsigned colours = 1;
  for (int d = 0; d < D; ++d) {
    stride[d] = colours;
    colours *= pattern::axis_colours(2 * c.period[d], 3);
  }
  // The colour of a block that begins in part `part` of the base cell.
  const auto colour_of = [&](const ivec<D>& base, unsigned part) {
    unsigned colour = 0;
    for (int d = 0; d < D; ++d) {
      const std::int64_t period = c.period[d];
      const std::int64_t cell = period == 0 ? base[d] + 3 : (base[d] + period) % period;  // a base cell may lie at -1
      colour += stride[d] * pattern::axis_colour(2 * cell + (part >> d & 1), 2 * period, 3);
    }
    return colour;
  };
  const std::size_t pieces = static_cast<std::size_t>(t.threads());
  std::vector<std::vector<std::size_t>> next(pieces, std::vector<std::size_t>(colours, 0));
  std::vector<std::size_t> next_block(pieces, 0);
  const auto in_pieces = [&](auto&& visit) {
    t.for_pieces(c.fluid_cells, [&](std::size_t begin, std::size_t end, std::size_t piece) {
      each_block(c, begin + 1, end + 1, [&](unsigned, const block<D>& b) { visit(piece, b, base_of<D>(b, c)); });
    });
  };
  in_pieces([&](std::size_t piece, const block<D>&, const ivec<D>& base) {
    ++next_block[piece];
    for (unsigned part = 0; part < parts; ++part) ++next[piece][colour_of(base, part)];
  });
  std::size_t total = 0;
  for (std::size_t& n : next_block) total += std::exchange(n, total);
  if (total > std::numeric_limits<std::uint32_t>::max() / parts)
    throw error("half_cells numbers at most 2^32 blocks of half cells, here there are " +
                std::to_string(total * parts));
  blocks_.resize(total);
  by_colour_.resize(colours);
  for (unsigned colour = 0; colour < colours; ++colour) {
    std::size_t n = 0;
    for (auto& counts : next) n += std::exchange(counts[colour], n);
    by_colour_[colour].resize(n);
  }
  in_pieces([&](std::size_t piece, const block<D>& b, const ivec<D>& base) {
    const std::size_t number = next_block[piece]++;
    blocks_[number] = b;
    for (unsigned part = 0; part < parts; ++part) {
      const unsigned colour = colour_of(base, part);
      by_colour_[colour][next[piece][colour]++] = static_cast<std::uint32_t>(number * parts + part);
    }
  });
  std::erase_if(by_colour_, [](const auto& list) { return list.empty(); });
  revision_ = c.revision;
}

#define PAIRSUM_HALF_BLOCKS(D) template class half_blocks<D>;
PAIRSUM_EACH_D(PAIRSUM_HALF_BLOCKS)

}  // namespace pairsum

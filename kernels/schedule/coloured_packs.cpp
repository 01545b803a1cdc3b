#include <pairsum/schedule/coloured_packs.hpp>

#include <bit>
#include <unordered_map>

#include <pairsum/core/error.hpp>
#include <pairsum/core/places.hpp>
#include <pairsum/grid/place_hash.hpp>

namespace pairsum {
namespace {

struct pack_of_base {
  std::uint32_t number;
  unsigned colour;  ///< by the pattern
};

/// Numbers the packs as their base cells are met.
template <int D>
class pack_numbers {
 public:
  pack_of_base find(const ivec<D>& base, const cells<D>& c) {
    ivec<D> at, pack;
    int ends = 0;
    for (int d = 0; d < D; ++d) {
      const std::int64_t period = c.period[d];
      at[d] = period == 0 ? base[d] + 8 : (base[d] + period) % period;  // a base cell may lie at -1
      ends += at[d] % 4 == 0 || at[d] % 4 == 3;
    }
    const bool shifted = ends > 1;
    unsigned parity = 0;
    for (int d = 0; d < D; ++d) {
      const std::int64_t period = c.period[d];
      pack[d] = (at[d] + (shifted ? 2 : 0)) / 4;
      if (period % 4 == 0 && period > 0) pack[d] %= period / 4;
      parity ^= static_cast<unsigned>(pack[d] & 1);
    }
    auto& known = known_[shifted];
    const auto number = known.try_emplace(pack, count_);
    count_ += number.second;
    return {number.first->second, shifted ? D == 2 ? 2 : 2 + parity : parity};
  }
  std::uint32_t count() const { return count_; }

 private:
  std::unordered_map<ivec<D>, std::uint32_t, place_hash<D>> known_[2];
  std::uint32_t count_ = 0;
};

}  // namespace

template <int D>
void coloured_packs<D>::build(const cells<D>& c) {
  if (c.revision == revision_ && revision_ != 0) return;
  revision_ = 0;
  std::vector<block<D>> met;
  std::vector<std::uint32_t> pack;
  std::vector<unsigned> colour;
  pack_numbers<D> numbers;
  each_block(c, 1, c.fluid_cells + 1, [&](unsigned, const block<D>& members) {
    const pack_of_base p = numbers.find(base_of<D>(members, c), c);
    met.push_back(members);
    pack.push_back(p.number);
    if (p.number == colour.size()) colour.push_back(p.colour);
  });
  // Blocks by pack, in the order they were met.
  std::vector<std::size_t> begin(numbers.count() + 1, 0);
  for (const std::uint32_t p : pack) ++begin[p + 1];
  for (std::size_t p = 1; p < begin.size(); ++p) begin[p] += begin[p - 1];
  blocks_.resize(met.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < met.size(); ++k) blocks_[next[pack[k]]++] = met[k];

  packs_.assign(pattern_colours, {});
  std::vector<std::uint32_t> been(c.range.size(), 0);  // by cell, a bit for each colour
  for (std::size_t p = 0; p < numbers.count(); ++p) {
    std::uint32_t taken = 0;
    const auto each_cell = [&](auto&& f) {
      for (std::size_t k = begin[p]; k < begin[p + 1]; ++k)
        for (const std::uint32_t cell : blocks_[k])
          if (cell != 0) f(been[cell]);
    };
    each_cell([&](std::uint32_t colours) { taken |= colours; });
    unsigned own = colour[p];
    if (taken >> own & 1) {
      own = static_cast<unsigned>(std::countr_one(taken | ((1u << pattern_colours) - 1)));
      if (own >= 32) throw error("colour4 found no colours for the seam of a torus of so few cells");
    }
    each_cell([&](std::uint32_t& colours) { colours |= std::uint32_t{1} << own; });
    if (own >= packs_.size()) packs_.resize(own + 1);
    packs_[own].push_back({begin[p], begin[p + 1]});
  }
  std::erase_if(packs_, [](const auto& list) { return list.empty(); });
  revision_ = c.revision;
}

#define PAIRSUM_COLOURED_PACKS(D) template class coloured_packs<D>;
PAIRSUM_EACH_D(PAIRSUM_COLOURED_PACKS)

}  // namespace pairsum

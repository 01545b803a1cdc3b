#include <pairsum/grid/merge_plan.hpp>

namespace pairsum {

void merge_plan::make(std::span<const std::uint32_t> keys, std::span<const mover> movers, int bits, const team& t) {
  n_ = keys.size();
  pieces_.resize(static_cast<std::size_t>(t.threads()));
  ends_.resize(pieces_.size());
  t.for_pieces(n_, [&](std::size_t, std::size_t end, std::size_t p) {
    ends_[p] = end;
    pieces_[p].runs.clear();
    pieces_[p].jumps.clear();
  });
  const std::size_t m = movers.size();
  mover_keys_.resize(m);
  for (std::size_t k = 0; k < m; ++k) mover_keys_[k] = movers[k].key;
  sort_.sort(mover_keys_, bits, t);
  const auto order = sort_.order();
  // A mover goes into the gap before the first element that has a larger key, or the same and lay behind it: of those
  // with the same key, which are together, it came before all or after all.
  gaps_.resize(m);
  t.for_pieces(m, [&](std::size_t begin, std::size_t end, std::size_t) {
    auto at = keys.begin();
    for (std::size_t k = begin; k < end; ++k) {
      const mover& a = movers[order[k]];
      at = std::lower_bound(at, keys.end(), a.key);
      const bool before = a.from < at - keys.begin();
      gaps_[k] = static_cast<std::uint32_t>((before ? at : std::upper_bound(at, keys.end(), a.key)) - keys.begin());
    }
  });
  // Walks through the places where something is taken out or put in; between them elements shift alike.
  std::size_t out = 0, in = 0;
  std::uint32_t here = 0;
  while (out < m || in < m) {
    const std::int64_t by = static_cast<std::int64_t>(in) - static_cast<std::int64_t>(out);
    if (in < m && (out == m || gaps_[in] <= movers[out].from)) {
      add_run(here, gaps_[in], by);
      here = gaps_[in];
      const auto to = static_cast<std::uint32_t>(here + by);
      pieces_[piece_of(to)].jumps.push_back({movers[order[in++]].from, to});
    } else {
      add_run(here, movers[out].from, by);
      here = movers[out++].from + 1;
    }
  }
  saved_ = 0;
  for (piece& p : pieces_) {
    p.scratch = saved_;
    saved_ += p.jumps.size();
  }
}

std::size_t merge_plan::piece_of(std::size_t position) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(ends_, position) - ends_.begin());
}

/// Cuts a run where its source or its target goes over from one piece to the next.
void merge_plan::add_run(std::uint32_t begin, std::uint32_t end, std::int64_t by) {
  while (by != 0 && begin < end) {
    const auto target = static_cast<std::size_t>(begin + by);
    const std::size_t from = piece_of(begin), to = piece_of(target);
    const auto stop =
        static_cast<std::uint32_t>(std::min({std::size_t{end}, ends_[from], begin + (ends_[to] - target)}));
    if (from == to)
      pieces_[from].runs.push_back({begin, stop, by});
    else
      for (std::uint32_t k = begin; k < stop; ++k) pieces_[to].jumps.push_back({k, static_cast<std::uint32_t>(k + by)});
    begin = stop;
  }
}

}  // namespace pairsum

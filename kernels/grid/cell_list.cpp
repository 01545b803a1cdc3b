#include <pairsum/grid/cell_list.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include <pairsum/core/error.hpp>
#include <pairsum/core/places.hpp>

namespace pairsum {
namespace {

template <int D, class R>
cell_place<D> place_of(const particle_set<D, R>& p, std::size_t i, const cell_scale<D, R>& scale) {
  cell_place<D> at;
  for (int d = 0; d < D; ++d) at.c[d] = scale.template cell<std::int64_t>(d, p.x[d][i]);
  return at;
}

template <class Place>
void sort_unique(std::vector<Place>& places) {
  if (!std::ranges::is_sorted(places)) std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
}

template <class Place>
std::vector<Place> joined(const std::vector<Place>& a, const std::vector<Place>& b) {
  std::vector<Place> both;
  both.reserve(a.size() + b.size());
  std::ranges::set_union(a, b, std::back_inserter(both));
  return both;
}

/// The cells of particles first..last that are summed, ascending.
template <int D, class R>
std::vector<cell_place<D>> places_of(const particle_set<D, R>& p, std::size_t first, std::size_t last,
                                     const box<D, R>& omega, const cell_scale<D, R>& scale, const team& t) {
  std::vector<std::vector<cell_place<D>>> found(static_cast<std::size_t>(t.threads()));
  t.for_pieces(last - first, [&](std::size_t begin, std::size_t end, std::size_t piece) {
    begin += first, end += first;
    std::vector<cell_place<D>>& own = found[piece];
    std::size_t tidy = 1024;
    for (std::size_t i = begin; i < end; ++i) {
      if (p.kind[i] == particle_kind::lost || !omega.contains(p.position(i))) continue;
      const cell_place<D> at = place_of(p, i, scale);
      if (!own.empty() && own.back() == at) continue;  // particles of a cell follow each other once they are sorted
      own.push_back(at);
      if (own.size() < tidy) continue;
      sort_unique(own);  // so that the list never grows much beyond the cells there are
      tidy = std::max(tidy, 2 * own.size());
    }
    sort_unique(own);
  });
  std::vector<cell_place<D>> all = std::move(found.front());
  for (std::size_t piece = 1; piece < found.size(); ++piece) all = joined(all, found[piece]);
  return all;
}

}  // namespace

template <int D, class R>
bool cell_list<D, R>::fit(const particle_set<D, R>& p, std::size_t moved, const box<D, R>& omega,
                          const cell_scale<D, R>& scale, const team& t) {
  if (moved != rest_begin_ || moved == p.size()) {
    rest_ = places_of(p, moved, p.size(), omega, scale, t);
    rest_begin_ = moved;
  }
  std::vector<cell_place<D>> all = joined(rest_, places_of(p, 0, moved, omega, scale, t));
  if (all.size() >= std::size_t{1} << 30)
    throw error("compact_grid holds fewer than 2^30 cells with particles, not " + std::to_string(all.size()));
  if (all == places_) return false;
  places_ = std::move(all);
  return true;
}

template <int D, class R>
void cell_list<D, R>::ranks(const particle_set<D, R>& p, std::size_t begin, std::size_t end,
                            const cell_scale<D, R>& scale, std::span<std::uint32_t> out) const {
  std::size_t rank = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const cell_place<D> at = place_of(p, i, scale);
    const auto is = [&](std::size_t k) { return k < places_.size() && places_[k] == at; };
    if (!is(rank) && !is(++rank))  // the cell of the particle before, or the next one
      rank = static_cast<std::size_t>(std::ranges::lower_bound(places_, at) - places_.begin());
    out[i - begin] = static_cast<std::uint32_t>(rank);
  }
}

#define PAIRSUM_CELL_LIST(D, R) template class cell_list<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_CELL_LIST)

}  // namespace pairsum

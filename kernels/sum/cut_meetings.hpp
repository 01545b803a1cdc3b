#pragma once
// What listers leave out where a rank's domain ends. o are own particles, g ghosts:
//
//   cell:        o o o | g g          a meeting of its particles with candidates  ->  own with all candidates
//   candidates:  o o | g | o o o                                                      ghosts with own candidates
//
// So no two ghosts are tested. A gather has the first part alone. In mode `once` the pairs of own particles with ghosts
// that the other rank sums are taken out of the rows that were found.
#include <algorithm>

#include <pairsum/sum/ghosts.hpp>
#include <pairsum/sum/meeting.hpp>
#include <pairsum/sum/pair_sum.hpp>
#include <pairsum/sum/search_space.hpp>

namespace pairsum {

/// What a pair found is to this rank.
enum class cut_state {
  whole,   ///< both particles are its own
  ours,    ///< one is; the pair is summed here
  others,  ///< one is; another rank sums the pair
};

/// Of numbers a and b of the space.
template <int D, class R>
cut_state state_of_pair(const search_space<D, R>& s, std::uint32_t a, std::uint32_t b) {
  if (s.ghosts == nullptr) return cut_state::whole;
  const std::uint32_t i = s.order != nullptr ? s.order[a] : a, j = s.order != nullptr ? s.order[b] : b;
  if (s.ghosts->is_ghost(i) == s.ghosts->is_ghost(j)) return cut_state::whole;
  return s.ghosts->is_summed(i, j) ? cut_state::ours : cut_state::others;
}

/// May there be ghosts in the meeting? A space with an order of its own does not say.
template <int D, class R>
bool meets_ghosts(const search_space<D, R>& s, const meeting<D>& m) {
  if (s.order != nullptr || s.ghosts->ghosts_in({m.begin, m.end}) > 0) return true;
  return std::ranges::any_of(m.fluid, [&](const index_range& r) { return s.ghosts->ghosts_in(r) > 0; });
}

/// Calls emit(meeting) for the parts of a meeting in which no two ghosts meet.
template <int D, class R, class Emit>
void each_cut(const search_space<D, R>& s, const meeting<D>& m, Emit&& emit) {
  const ghost_marks& g = *s.ghosts;
  const auto is_ghost = [&](std::uint32_t k) { return g.is_ghost(s.order != nullptr ? s.order[k] : k); };
  std::uint32_t first_ghost = m.end;
  while (first_ghost > m.begin && is_ghost(first_ghost - 1)) --first_ghost;
  if (first_ghost == m.end) return emit(m);
  meeting<D> part = m;
  part.end = first_ghost;
  if (!part.empty()) emit(part);
  if (m.who == partners::others) return;
  part.begin = first_ghost;
  part.end = m.end;
  part.who = partners::all;
  part.fluid.clear();
  part.boundary.clear();
  for (const index_range* r = m.fluid.begin(); r != m.fluid.end(); ++r) {
    // Of its own cell, a ghost meets what is before it, and these have met it.
    const std::uint32_t begin = m.who == partners::later && r == m.fluid.begin() ? m.end : r->begin;
    if (s.order == nullptr && g.ghosts_in({begin, r->end}) == r->end - begin) continue;
    for (std::uint32_t k = begin; k < r->end;) {
      while (k < r->end && is_ghost(k)) ++k;
      const std::uint32_t own = k;
      while (k < r->end && !is_ghost(k)) ++k;
      part.fluid.add({own, k});
    }
  }
  if (!part.empty()) emit(part);
}

/// Takes rows and hands them on without the pairs that another rank sums.
struct ours_alone {
  const row_sink& inner;
  const ghost_marks& ghosts;
  bool padded;  ///< vector units read whole vectors of partners

  static void take(const void* call, const row* rows, std::size_t n) {
    const auto& self = *static_cast<const ours_alone*>(call);
    for (std::size_t k = 0; k < n; ++k) {
      row r = rows[k];
      auto* const hits = const_cast<std::uint32_t*>(r.fluid);  // the lister's own
      std::uint32_t* const end =
          std::remove_if(hits, hits + r.fluid_count, [&](std::uint32_t j) { return !self.ghosts.is_summed(r.i, j); });
      if (self.padded) {
        const auto whole = (static_cast<std::size_t>(end - hits) + row_padding - 1) / row_padding * row_padding;
        for (std::uint32_t* pad = end; pad < hits + whole; ++pad)
          *pad = self.inner.spare + static_cast<std::uint32_t>(pad - end);
      }
      r.fluid_count = static_cast<std::uint32_t>(end - hits);
      if (r.fluid_count + r.boundary_count > 0) self.inner.take(self.inner.call, &r, 1);
    }
  }
};

}  // namespace pairsum

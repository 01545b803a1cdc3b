// Finds the candidates within the cutoff and passes rows of them to the formula. Distances are tested in a separate
// loop, which packs indices without a branch, so that no distance depends on branch prediction; the formula
// then runs on those alone. Nothing here knows a formula.
#include <vector>

#include <pairsum/core/same_code.hpp>
#include <pairsum/sum/cut_meetings.hpp>
#include <pairsum/sum/pack.hpp>
#include <pairsum/sum/prefetch.hpp>
#include <pairsum/sum/problem.hpp>
#include <pairsum/sum/vector_lister.hpp>

namespace pairsum {
namespace {

template <int D, class R>
[[gnu::always_inline]] inline std::uint32_t* pack(const positions<D, R>& x, const point<D, R>& x_i, R reach2,
                                                  std::uint32_t begin, std::uint32_t end, std::uint32_t* to) {
  return pack_of(
      x, x_i, reach2, begin, end, to, [](std::uint32_t k) __attribute__((always_inline)) { return k; });
}

/// The partners of particle i, candidate number i of the space, written to `to`, which has room for all candidates.
template <int D, class R>
[[gnu::always_inline]] inline row row_of(const search_space<D, R>& s, const meeting<D>& m, std::uint32_t i,
                                         std::uint32_t* to) {
  const auto x_i = s.x.point_of(i);
  row r;
  r.i = i;
  r.fluid = to;
  if (m.who == partners::others) {
    for (const index_range& f : m.fluid) {
      if (i < f.begin || i >= f.end) {
        to = pack(s.x, x_i, s.reach2, f.begin, f.end, to);
      } else {
        to = pack(s.x, x_i, s.reach2, f.begin, i, to);
        to = pack(s.x, x_i, s.reach2, i + 1, f.end, to);
      }
    }
  } else {
    const bool later = m.who == partners::later;
    for (const index_range *f = m.fluid.begin(), *end = m.fluid.end(); f != end; ++f)
      to = pack(s.x, x_i, s.reach2, later && f == m.fluid.begin() ? i + 1 : f->begin, f->end, to);
  }
  r.fluid_count = static_cast<std::uint32_t>(to - r.fluid);
  r.boundary = to;
  if (s.boundary_reach2 > 0)
    for (const index_range& b : m.boundary) to = pack(s.x, x_i, s.boundary_reach2, b.begin, b.end, to);
  r.boundary_count = static_cast<std::uint32_t>(to - r.boundary);
  return r;
}

/// From numbers in the space's order to particles.
inline void rename(row& r, const std::uint32_t* order) {
  auto* const hits = const_cast<std::uint32_t*>(r.fluid);
  for (std::uint32_t k = 0; k < r.fluid_count + r.boundary_count; ++k) hits[k] = order[hits[k]];
  r.i = order[r.i];
}

template <int D, class R>
void count_row(const search_space<D, R>& s, const row& r, const meeting<D>& m, work_counts& counts) {
  counts.pairs_tested += m.fluid.size() + m.boundary.size();
  if (m.who == partners::later) counts.pairs_tested -= r.i + 1 - m.begin;
  if (m.who == partners::others) --counts.pairs_tested;  // itself
  counts.pairs_fluid_boundary += r.boundary_count;
  for (std::uint32_t k = 0; k < r.fluid_count; ++k) {
    const cut_state cut = state_of_pair(s, r.i, r.fluid[k]);
    const bool seen_twice = m.who == partners::others && cut == cut_state::whole;
    counts.pairs_fluid_fluid += cut != cut_state::others && !(seen_twice && r.fluid[k] > r.i);
    counts.pairs_cut += cut == cut_state::ours;
  }
}

/// A particle with more candidates than a thread keeps room for.
template <int D, class R>
[[gnu::noinline]] void list_large(const search_space<D, R>& s, const row_sink& sink, const meeting<D>& m,
                                  std::uint32_t i, std::size_t candidates, work_counts* counts) {
  std::vector<std::uint32_t> hits(candidates + 1);
  row r = row_of(s, m, i, hits.data());
  if (counts != nullptr) count_row(s, r, m, *counts);
  if (s.order != nullptr) rename(r, s.order);
  sink.take(sink.call, &r, 1);
}

template <int D, class R>
PAIRSUM_SAME_CODE void list_rows(const search_space<D, R>& s, const row_sink& sink, const meeting<D>* all, unsigned n,
                                 work_counts* counts) {
  std::uint32_t hits[most_hits + 1];  // one more is written than passes
  row rows[most_rows];
  std::uint32_t* to = hits;
  std::size_t filled = 0;
  const auto flush = [&]() __attribute__((always_inline)) {
    if (filled > 0) sink.take(sink.call, rows, filled);
    to = hits;
    filled = 0;
  };
  for (unsigned k = 0; k < n; ++k) {
    const meeting<D>& m = all[k];
    const bool keep_empty = m.who == partners::others;
    const std::size_t candidates = m.fluid.size() + m.boundary.size();
    for (std::uint32_t i = m.begin; i < m.end; ++i) {
      if (filled == most_rows || candidates > static_cast<std::size_t>(hits + most_hits - to)) {
        flush();
        if (candidates > most_hits) [[unlikely]] {
          list_large(s, sink, m, i, candidates, counts);
          continue;
        }
      }
      row& r = rows[filled];
      r = row_of(s, m, i, to);
      if (counts != nullptr) [[unlikely]]
        count_row(s, r, m, *counts);
      const std::uint32_t found = r.fluid_count + r.boundary_count;
      if (found == 0 && !keep_empty) continue;
      if (s.order != nullptr) rename(r, s.order);
      to += found;
      ++filled;
    }
  }
  flush();
}

/// With ghosts: their pairs with each other are left out, and in mode `once` those that another rank sums.
template <int D, class R>
[[gnu::noinline]] void list_cut_meetings(const problem<D, R>& p, const search_space<D, R>& space, const row_sink& sink,
                                         const meeting<D>* m, unsigned n, work_counts* counts) {
  const ours_alone filter{sink, *space.ghosts, p.lanes != nullptr};
  const row_sink to = space.ghosts->pairs == cut_pairs::once ? row_sink{&ours_alone::take, &filter, sink.spare} : sink;
  const auto list = [&](const row_sink& taker, const meeting<D>* some, unsigned size) {
    if (p.lanes != nullptr)
      p.lanes->list(space.places, space.order, taker, some, size);
    else
      list_rows(space, taker, some, size, counts);
  };
  for (unsigned k = 0; k < n;) {
    unsigned end = k;
    while (end < n && !meets_ghosts(space, m[end])) ++end;
    if (end > k) list(sink, m + k, end - k);
    if (end < n) each_cut(space, m[end], [&](const meeting<D>& part) { list(to, &part, 1); });
    k = end + 1;
  }
}

}  // namespace

template <int D, class R>
void list_meetings(const problem<D, R>& p, const search_space<D, R>& space, const row_sink& sink, const meeting<D>* m,
                   unsigned n, work_counts* counts) {
  if (space.ghosts != nullptr) [[unlikely]]
    return list_cut_meetings(p, space, sink, m, n, counts);
  if (p.lanes != nullptr)
    p.lanes->list(space.places, space.order, sink, m, n);
  else
    list_rows(space, sink, m, n, counts);
}

template <int D, class R>
void sum_meetings(const problem<D, R>& p, const search_space<D, R>& space, const target& to, const meeting<D>* m,
                  unsigned n) {
  if (n == 0) return;
  const sum_call<D, R> call{p, to};
  const rows_function take = m->who == partners::others ? p.pairs->own : both_sides(p, to.how);
  const row_sink sink{take, &call, p.spare_of(to.thread)};
  if (p.counts != nullptr) [[unlikely]] {
    const counted_rows counted{sink, *p.counts};
    list_meetings(p, space, {&counted_rows::take, &counted, sink.spare}, m, n, p.counts);
  } else {
    list_meetings<D, R>(p, space, sink, m, n, nullptr);
  }
}

template <int D, class R>
void sum_cells(const problem<D, R>& p, const target& to, partners who, const std::uint32_t* cell, std::size_t n) {
  const bool half = who == partners::later;
  // Finding and summing in one function adds to the problem's own rates alone.
  const bool at_once = p.lanes != nullptr && to.how == update::plain && to.u.begin == p.u.begin;
  const auto sum_at_once = [&](const std::uint32_t* some, std::size_t size) {
    const sum_call<D, R> call{p, to};
    return (half ? p.pairs->half_stencils : p.pairs->full_stencils)(call, some, size);
  };
  if (at_once && p.ghosts == nullptr) return sum_at_once(cell, n);
  for (std::size_t k = 0; k < n; ++k) {
    if (at_once) {
      std::size_t end = k;
      while (end < n && p.ghosts->near[cell[end]] == 0) ++end;
      if (end > k) sum_at_once(cell + k, end - k);
      if (end == n) return;
      k = end;
    }
    if (half) {
      fetch_in_list<true>(p, cell, n, k, to);
      sum_meetings(p, to, half_stencil(p.cells(), cell[k], p.counts));
    } else {
      fetch_in_list<false>(p, cell, n, k, to);
      sum_meetings(p, to, full_stencil(p.cells(), cell[k]));
    }
  }
}

#define PAIRSUM_LISTERS(D, R)                                                                                      \
  template void list_meetings(const problem<D, R>&, const search_space<D, R>&, const row_sink&, const meeting<D>*, \
                              unsigned, work_counts*);                                                             \
  template void sum_meetings(const problem<D, R>&, const search_space<D, R>&, const target&, const meeting<D>*,    \
                             unsigned);                                                                            \
  template void sum_cells(const problem<D, R>&, const target&, partners, const std::uint32_t*, std::size_t);
PAIRSUM_EACH_D_R(PAIRSUM_LISTERS)

}  // namespace pairsum

#pragma once
#include <pairsum/sum/vector_lister.hpp>
#include <pairsum/vector/nearby.hpp>

namespace pairsum {

/// The function that the sink names sums the rows.
struct by_sink {
  static constexpr bool has_boundary = true;
  static HWY_INLINE void sum(const row_sink& sink, const row* rows, std::size_t n) { sink.take(sink.call, rows, n); }
};

/// Rows of a few particles, buffered for Sum.
template <class V, class Sum>
class alignas(4096) row_batch {
  using index_tag = lane_tag<std::uint32_t>;

 public:
  explicit row_batch(const row_sink& sink) : sink_(sink) {}

  /// Room for this many particles with up to so many partners each: at least one after a flush.
  HWY_INLINE std::size_t particles_for(std::size_t partners) {
    const auto fitting = [&] {
      return std::min(most_rows - n_, static_cast<std::size_t>(hits_ + capacity - to_) / (partners + 3 * row_padding));
    };
    const std::size_t n = fitting();
    if (n > 0) [[likely]]
      return n;
    by_sink::sum(sink_, rows_, n_);
    n_ = 0;
    to_ = hits_;
    return fitting();
  }
  HWY_INLINE std::uint32_t* free() { return to_; }
  /// The entries from free() to `end` are fluid partners of particle i.
  HWY_INLINE void add_fluid(std::uint32_t i, std::uint32_t* end) {
    const index_tag d;
    constexpr std::size_t L = hn::MaxLanes(d);
    for (std::size_t k = 0; k < row_padding; k += L) hn::StoreU(numbered_from(d, sink_.spare + k), d, end + k);
    rows_[n_] = {to_, end, static_cast<std::uint32_t>(end - to_), 0, i};
    n_ += end != to_;
    to_ += (static_cast<std::size_t>(end - to_) + row_padding - 1) / row_padding * row_padding;  // whole vectors
  }
  HWY_INLINE void add_boundary(std::uint32_t i, std::uint32_t* end) {
    rows_[n_] = {to_, to_, 0, static_cast<std::uint32_t>(end - to_), i};
    n_ += end != to_;
    to_ = end;
  }
  HWY_INLINE void flush() {
    if (n_ > 0) Sum::sum(sink_, rows_, n_);
    n_ = 0;
    to_ = hits_;
  }

 private:
  static constexpr std::size_t capacity = 2048, most_rows = 32;

  // At different offsets of a page from each other and from the candidates read at the same time: see nearby.
  char apart_[2880];
  HWY_ALIGN std::uint32_t hits_[capacity];
  char more_apart_[896];
  row rows_[most_rows + 1];
  const row_sink& sink_;
  std::uint32_t* to_ = hits_;
  std::size_t n_ = 0;
};

/// Lists rows on the vector units of one instruction set (that of V):
///
///   copy the candidates of a meeting together               nearby
///   for its particles i:
///     row(i) = candidates that pass the test, packed without gaps     a vector of tests at a time
///   sum rows, full vectors but for the last
template <int D, class V, class Sum = by_sink>
class lane_lister {
  using plain_list = nearby<D, V, false>;
  using ordered_list = nearby<D, V, true>;
  using batch = row_batch<V, Sum>;
  using places = lane_places<D>;

 public:
  static void list(const places& t, const std::uint32_t* order, const row_sink& sink, const meeting<D>* m, unsigned n) {
    if (order != nullptr)
      list_in<ordered_list>(t, order, sink, m, n);
    else
      list_in<plain_list>(t, nullptr, sink, m, n);
  }

  /// The half (partners later) or full stencils (others) of cell[0..n), one after the other, with software prefetch of
  /// the next rows, `stride` bytes each.
  template <partners who, std::size_t stride>
  static HWY_INLINE void list_cells(const places& t, const cells<D>& c, const std::byte* rows, const row_sink& sink,
                                    const std::uint32_t* cell, std::size_t n) {
    plain_list near(nullptr);
    batch b(sink);
    for (std::size_t k = 0; k < n; ++k) {
      fetch_ahead<who == partners::later, stride>(t, c, rows, cell, n, k);
      const meeting<D> m = who == partners::later ? half_stencil(c, cell[k], nullptr) : full_stencil(c, cell[k]);
      list_fluid<who>(t, m, nullptr, near, b);
      if (Sum::has_boundary && !m.boundary.empty()) list_boundary(t, m, nullptr, near, b);
      b.flush();  // now, while its particles are in the cache
    }
  }

 private:
  template <class near_list>
  static HWY_INLINE void list_in(const places& t, const std::uint32_t* order, const row_sink& sink, const meeting<D>* m,
                                 unsigned n) {
    near_list near(order);
    batch b(sink);
    for (unsigned k = 0; k < n; ++k) {
      if (m[k].who == partners::later)
        list_fluid<partners::later>(t, m[k], order, near, b);
      else if (m[k].who == partners::others)
        list_fluid<partners::others>(t, m[k], order, near, b);
      else
        list_fluid<partners::all>(t, m[k], order, near, b);
      if (t.boundary_reach > 0 && !m[k].boundary.empty()) list_boundary(t, m[k], order, near, b);
    }
    b.flush();
  }

  // g++ takes a function that only prefetches for one without effect and drops its calls, unless it is inlined first.
  /// Software prefetch for a sweep over cell[0..n) at number k: rows and positions of particles near the next cell and
  /// not near this one, if cells are swept row by row; and the ranges of later cells. Which rows are read depends on
  /// hits, so hardware cannot predict them: without this, a million particles take 1.4 times as long.
  template <bool half, std::size_t stride>
  static HWY_INLINE void fetch_ahead(const places& t, const cells<D>& c, const std::byte* rows,
                                     const std::uint32_t* cell, std::size_t n, std::size_t k) {
    constexpr std::size_t line = 64;
    if (k + 1 == n) return;
    const std::uint32_t* const soon = c.neighbours_of(cell[std::min(k + 4, n - 1)]);
    __builtin_prefetch(soon + pattern::stencil_centre<D>);
    __builtin_prefetch(soon + pattern::stencil_cells<D> - 1);
    const std::uint32_t* const later = c.neighbours_of(cell[std::min(k + 2, n - 1)]);
    const std::uint32_t* const next = c.neighbours_of(cell[k + 1]);
    pattern::each_ahead<D, half>([&](unsigned code)
                                     __attribute__((always_inline)) { __builtin_prefetch(&c.range[later[code]]); });
    pattern::each_ahead<D, half>([&](unsigned code) __attribute__((always_inline)) {
      const cell_range& range = c.range[next[code]];
      if (range.fluid.size() == 0) return;
      // Rows may lie across cache lines (those of mixed do).
      std::size_t at = range.fluid.begin * stride / line * line;
      const std::size_t end = range.fluid.end * stride;
      for (; at < end; at += line) __builtin_prefetch(rows + at);
      for (const std::int32_t* const place : t.place) __builtin_prefetch(place + range.fluid.end - 1);
    });
  }

  template <partners who, class near_list>
  static HWY_INLINE void list_fluid(const places& t, const meeting<D>& m, const std::uint32_t* order, near_list& near,
                                    batch& b) {
    if (m.fluid.empty()) return;
    // Candidate number own_at + s of the sequence is particle m.begin + s.
    const std::size_t own_at = who == partners::others ? place_of(m) : 0;
    each_near(t, m, m.fluid, 1, near, b, [&](std::uint32_t i, const float(&place)[D], std::size_t first) HWY_ATTR {
      const std::size_t slot = own_at + (i - m.begin);
      const std::uint32_t particle = order == nullptr ? i : order[i];
      if (who == partners::all || slot < first)  // candidates without it
        b.add_fluid(particle, near.find(place, b.free()));
      else if constexpr (who == partners::later)
        b.add_fluid(particle, near.find_after(place, slot - first, b.free()));
      else
        b.add_fluid(particle, near.find_but(place, slot - first, b.free()));
    });
  }
  template <class near_list>
  static HWY_NOINLINE void list_boundary(const places& t, const meeting<D>& m, const std::uint32_t* order,
                                         near_list& near, batch& b) {
    each_near(t, m, m.boundary, t.boundary_reach, near, b,
              [&](std::uint32_t i, const float(&place)[D], std::size_t)
                  HWY_ATTR { b.add_boundary(order == nullptr ? i : order[i], near.find(place, b.free())); });
  }

  /// The number of the first particle among the candidates.
  static std::size_t place_of(const meeting<D>& m) {
    std::size_t at = 0;
    for (const index_range& r : m.fluid) {
      if (m.begin >= r.begin && m.begin < r.end) return at + (m.begin - r.begin);
      at += r.end - r.begin;
    }
    return 0;  // unreachable: it is among them
  }

  using range_array = range_list<pattern::stencil_cells<D> + 1>;
  /// The next candidate in a sequence of ranges.
  struct cursor {
    const index_range *at, *end;
    index_range rest;
    explicit cursor(const range_array& ranges) : at(ranges.begin()), end(ranges.end()), rest(*at) {}
    bool done() const { return at == end; }
  };

  /// Fills `near` with candidates around particle i, from the cursor on, until it is full; returns the cursor behind
  /// them.
  template <class near_list>
  static HWY_INLINE cursor copy(const places& t, std::uint32_t i, float reach, cursor c, near_list& near) {
    if (t.periodic)
      near.clear(t.place, i, reach, t.excess, t.place_size, t.half_edge);
    else
      near.clear(t.place, i, reach, t.excess);
    while (!c.done() && !near.full()) {
      near.take(t.place, c.rest);
      if (c.rest.begin == c.rest.end && ++c.at != c.end) c.rest = *c.at;
    }
    near.close();
    return c;
  }
  template <class near_list>
  static HWY_NOINLINE void copy_again(const places& t, std::uint32_t i, float reach, cursor c, near_list& near,
                                      float (&place)[D]) {
    copy(t, i, reach, c, near);
    near.has_near(t.place, i, place);
  }

  /// Calls visit(i, place, first) for every particle of the meeting, `near` holding the candidates around it from
  /// number `first` on; all again for each piece of the candidates if they are too many to be copied at once.
  template <class near_list, class Visit>
  static HWY_INLINE void each_near(const places& t, const meeting<D>& m, const range_array& ranges, float reach,
                                   near_list& near, batch& b, Visit&& visit) {
    std::size_t first = 0;
    for (cursor c(ranges); !c.done(); first += near.size()) {
      const cursor start = c;
      c = copy(t, m.begin, reach, c, near);
      for (std::uint32_t i = m.begin; i < m.end;) {
        const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(m.end, i + b.particles_for(near.size())));
        for (; i < end; ++i) {
          float place[D];
          if (!near.has_near(t.place, i, place)) [[unlikely]]
            copy_again(t, i, reach, start, near, place);
          visit(i, place, first);
        }
      }
    }
  }
};

}  // namespace pairsum

#pragma once
#include "vector/boundary_sum.hpp"
#include "vector/fetch_ahead.hpp"
#include "vector/nearby.hpp"

namespace pairsum {

/// The sum over cells on vector units, for one instruction set (that of V):
///
///   copy the candidates of the cell together                          nearby
///   for i in cell:
///     hits(i) = candidates that pass the test, packed without gaps    a vector of tests at a time
///   for i in cell, for each vector of its hits j:                     full but for the last
///     load the rows of its particles, transposed                      load_rows
///     c = f(i, j), 0 in lanes out of reach
///     u_i += c.to_i                                                   lane by lane, summed at the end
///     u_j += c.to_j                                                   add_to_rows, one row after the other
///
/// Touches the rates of the cell and, if symmetric, of its forward neighbours.
template <class I, class V>
class tile_kernel {
  using real = typename I::real;
  using tiles = tile_problem<I>;
  using batch = hit_batch<I, V>;
  using near_list = nearby<I::dim, V>;
  static constexpr int D = I::dim;
  static constexpr std::size_t S = tiles::rates;
  static constexpr unsigned stencil = cells<D>::stencil;
  using range_array = range_list<stencil + 1>;

 public:
  template <bool symmetric>
  static void sum(const tiles& t, const std::uint32_t* cell, std::size_t n, std::uint32_t spare) {
    near_list near;
    batch b(t, spare);
    for (std::size_t k = 0; k < n; ++k) {
      fetch_rows_ahead<symmetric>(t, cell, n, k);
      sum_cell<symmetric>(t, cell[k], near, b);
    }
  }

 private:
  template <bool symmetric>
  static HWY_INLINE void sum_cell(const tiles& t, std::size_t cell, near_list& near, batch& b) {
    constexpr unsigned centre = pattern::stencil_centre<D>;
    const problem<I>& p = *t.p;
    const cells<D>& c = p.cells();
    const cell_range& own = c.range[cell];
    range_array fluid, boundary;
    fluid.add(own.fluid_begin, own.fluid_end);
    for (unsigned n = 0; n < stencil; ++n) {
      const cell_range& other = c.range[c.neighbour(cell, n)];
      if (symmetric ? n > centre : n != centre) fluid.add(other.fluid_begin, other.fluid_end);
      if constexpr (has_boundary<I>) boundary.add(other.boundary_begin, other.boundary_end);
    }
    // Candidate number s of the sequence is particle own.fluid_begin + s of the cell, as long as it is one of them.
    each_near(
        t, own, fluid, 1, near, [&] { return b.particles_for(near.size()); },
        [&](std::uint32_t i, const float(&place)[D], std::size_t first) HWY_ATTR {
          const std::size_t slot = i - own.fluid_begin;
          std::uint32_t* const hits = b.free();
          if (slot < first)  // a piece of the candidates without it
            b.add(i, near.find(place, hits));
          else if constexpr (symmetric)
            b.add(i, near.find_after(place, slot - first, hits));
          else
            b.add(i, near.find_but(place, slot - first, hits));
        },
        [&]() HWY_ATTR { b.template flush<symmetric>(); });
    if constexpr (has_boundary<I>)
      if (!boundary.empty()) sum_boundary<symmetric>(t, own, boundary, near);
  }

  template <bool symmetric>
  static HWY_NOINLINE void sum_boundary(const tiles& t, const cell_range& own, const range_array& boundary,
                                        near_list& near) {
    HWY_ALIGN std::uint32_t hits[near_list::capacity + lane_count<std::uint32_t>];
    each_near(
        t, own, boundary, static_cast<float>(boundary_reach<I>()), near, [&] { return std::size_t{own.fluid()}; },
        [&](std::uint32_t i, const float(&place)[D], std::size_t) HWY_ATTR {
          const std::uint32_t* const end = near.find(place, hits);
          if (end == hits) return;
          lane_vector<real> u[S];
          for (std::size_t s = 0; s < S; ++s) u[s] = hn::Zero(lane_tag<real>());
          add_boundary_lanes(t, i, hits, static_cast<std::size_t>(end - hits), u);
          add_sums<symmetric>(t, i, u);
        },
        [] {});
  }

  /// Where in a sequence of ranges the next candidate is.
  struct cursor {
    const index_range *at, *end;
    index_range rest;
    explicit cursor(const range_array& ranges) : at(ranges.begin()), end(ranges.end()), rest(*at) {}
    bool done() const { return at == end; }
  };

  /// Makes `near` hold candidates around particle i, from the cursor on, as many as it takes; returns the cursor behind
  /// them.
  static HWY_INLINE cursor copy(const tiles& t, std::uint32_t i, float reach, cursor c, near_list& near) {
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
  static HWY_NOINLINE void copy_again(const tiles& t, std::uint32_t i, float reach, cursor c, near_list& near,
                                      float (&place)[D]) {
    copy(t, i, reach, c, near);
    near.has_near(t.place, i, place);
  }

  /// Calls visit(i, place, first) for every fluid particle of the cell, `near` holding the candidates around it from
  /// number `first` on, and done() after every most() of them; all again for each piece of the candidates if they are
  /// too many to be copied at once.
  template <class Most, class Visit, class Done>
  static HWY_INLINE void each_near(const tiles& t, const cell_range& own, const range_array& ranges, float reach,
                                   near_list& near, Most&& most, Visit&& visit, Done&& done) {
    std::size_t first = 0;
    for (cursor c(ranges); !c.done(); first += near.size()) {
      const cursor start = c;
      c = copy(t, own.fluid_begin, reach, c, near);
      for (std::uint32_t i = own.fluid_begin; i < own.fluid_end;) {
        const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(own.fluid_end, i + most()));
        for (; i < end; ++i) {
          float place[D];
          if (!near.has_near(t.place, i, place)) [[unlikely]]
            copy_again(t, i, reach, start, near, place);
          visit(i, place, first);
        }
        done();
      }
    }
  }
};

}  // namespace pairsum

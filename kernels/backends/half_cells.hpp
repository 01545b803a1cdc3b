#pragma once
// The talk's passes on cells of half the reach, whose pairs are up to two cells apart:
//
//   prepare:  sort the particles by half cells
//   for each colour:                                      (2+1)^d = 27 in 3D, 9 in 2D, 3 in 1D; a barrier after each
//     parallel for base half cells B of the colour:
//       all pairs inside B
//       for j, k in {0,1,2}^d, k < j, min(j, k) = 0 in every component:  pairs between B+j and B+k
//
//     [B . .][B . .]        1D: a block is B and the two after it: pairs B-B, B-(B+1), B-(B+2); the pair (B+1)-(B+2) is
//                           that of another block
//
// Less volume is searched, (5/2 H)^d in place of (3 H)^d, in more and smaller cells. Race-free: blocks of a colour
// begin 3 half cells apart and are 3 wide (sum/half_blocks.hpp); on a torus, whose 2^(M+1) half cells no 3 divides,
// those at the seam have colours of their own. Bit-identical for every number of threads: neither order nor colours
// depend on it.
#include "core/omp_loop.hpp"
#include "pattern/half_pattern.hpp"
#include "sum/backend.hpp"
#include "sum/half_blocks.hpp"
#include "sum/half_cell_order.hpp"

namespace pairsum {

struct half_cells {
  static constexpr backend_traits traits{.name = "half_cells",
                                         .description = "the talk's passes on cells of half the width, with OpenMP",
                                         .aliases = "Newton-3, c08 with a cell size factor of 0.5 (AutoPas)",
                                         .threads = runtime::omp,
                                         .symmetric = true,
                                         .deterministic = true,
                                         .accumulates = true,
                                         .evaluations_per_pair = 1,
                                         .sweeps_per_colour = true,
                                         .keeps_pairs = false,
                                         .loop = {schedule::dynamic, 64},
                                         .cells_per_reach = 2,
                                         .colours = {3, 9, 27},
                                         .conflicts = conflict_avoidance::colours};

  template <class I>
  struct workspace {
    using real = typename I::real;
    static constexpr int D = I::dim;
    static constexpr unsigned members = pattern::stencil_cells<D>;
    using range_of_members = range_list<members + 1>;

    half_cell_order<D, real> order;
    half_blocks<D> blocks;

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe&) {
      order.build(p.x, p.cells(), p.count, t);
      blocks.build(p.cells(), t);
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      if (blocks.colours() > 0) probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      for (unsigned colour = 0; colour < blocks.colours(); ++colour)
        omp_pass(colour, blocks.size(colour), g, probe, [&](std::size_t k) {
          fetch_next(p, colour, k);
          sum_half_block(p, blocks(colour, k), probe);
        });
    }

   private:
    /// The half cells of a block: member o, at offset o of the pattern from its base.
    struct block_members {
      const cell_range* of[members];
      bool have_boundary;  ///< any of them

      block_members(const half_cell_order<D, real>& order, const typename half_blocks<D>::unit& b) {
        std::uint32_t boundary = 0;
        for (unsigned o = 0; o < members; ++o) {
          const auto [cell, part] = pattern::half_block_place<D>[b.part][o];
          of[o] = &order.range((*b.cells)[cell], part);
          boundary |= of[o]->boundary();
        }
        have_boundary = boundary != 0;
      }
    };

    template <class Probe>
    PAIRSUM_SAME_CODE void sum_half_block(const problem<I>& p, const typename half_blocks<D>::unit& b, Probe& probe) {
      const block_members member(order, b);
      const auto& lists = pattern::half_block<D>;
      for (unsigned j = 0; j < members; ++j) {
        const cell_range& own = *member.of[j];
        if (own.fluid() == 0) continue;
        range_of_members fluid, boundary;
        if (j == 0) fluid.add(own.fluid_begin, own.fluid_end);
        for (unsigned n = lists.later[j]; n < lists.begin[j + 1]; ++n) {
          const cell_range& other = *member.of[lists.offset[n]];
          fluid.add(other.fluid_begin, other.fluid_end);
        }
        if (has_boundary<I> && member.have_boundary) {
          for (unsigned n = lists.begin[j]; n < lists.begin[j + 1]; ++n) {
            const cell_range& other = *member.of[lists.offset[n]];
            boundary.add(other.boundary_begin, other.boundary_end);
          }
        }
        if constexpr (Probe::counting) count_cell_pairs(member, j, probe);
        if (fluid.empty() && boundary.empty()) continue;
        for (std::uint32_t i = own.fluid_begin; i < own.fluid_end; ++i) {
          if (j == 0) fluid.begin_first_at(i + 1);  // inside the base cell: with those behind i
          scatter(p, i, fluid, boundary, probe);
        }
      }
    }

    /// Counts for particles of member j as sum_block() does.
    template <class Probe>
    static void count_cell_pairs(const block_members& member, unsigned j, Probe& probe) {
      const auto& lists = pattern::half_block<D>;
      for (unsigned n = lists.begin[j]; n < lists.begin[j + 1]; ++n) {
        const unsigned k = lists.offset[n];
        const cell_range& other = *member.of[k];
        probe.sumF1(k == j);
        probe.sumF2(k != j && other.fluid() + other.boundary() > 0 && (k > j || other.fluid() == 0));
      }
    }

    /// scatter_one() for number i of the order, with ranges of such numbers. Most find nobody in reach: of fluid
    /// candidates one must be, before particle i is looked at.
    template <class Probe>
    [[gnu::always_inline]] void scatter(const problem<I>& p, std::uint32_t i, const range_of_members& fluid,
                                        const range_of_members& boundary, Probe& probe) {
      const positions<D, real> x = order.x();
      const auto x_i = x.point_of(i);
      const std::size_t n = filter_of<I>::batches_in_reach(
          x, x_i, p.reach2, fluid, [&](const std::uint32_t* hits, std::size_t n) __attribute__((always_inline)) {
            if (n == 0) return;
            const auto a = p.fluid.load(order[i]);
            auto u_i = zero<rates_of<I>>();
            for (std::size_t h = 0; h < n; ++h) {
              const vec<D, real> r = x_i - x[hits[h]];
              const std::uint32_t j = order[hits[h]];
              const auto c = p.formula->pair(r, norm2<D, real>(r), a, p.fluid.load(j));
              add(u_i, c.to_i);
              p.u.add(j, c.to_j);
            }
            p.u.add(order[i], u_i);
          });
      if constexpr (Probe::counting) {
        probe.tested(filter_of<I>::size(fluid));
        probe.fluid_pairs(n);
        probe.evaluated(n);
        probe.pairs_of_one(n);
      }
      if constexpr (has_boundary<I>) {
        if (boundary.empty()) return;
        const auto a = p.fluid.load(order[i]);
        auto u_i = zero<rates_of<I>>();
        const std::size_t m = filter_of<I>::each_in_reach(
            x, x_i, p.boundary_reach2, boundary, [&](std::uint32_t k) __attribute__((always_inline)) {
              const vec<D, real> r = x_i - x[k];
              add(u_i, p.formula->boundary(r, norm2<D, real>(r), a, p.boundary_particle(order[k])));
            });
        p.u.add(order[i], u_i);
        if constexpr (Probe::counting) {
          probe.tested(filter_of<I>::size(boundary));
          probe.boundary_pairs(m);
          probe.evaluated(m);
        }
      }
    }

    /// Asks for the particles of the block after number k, and for where those of a later one are.
    PAIRSUM_SAME_CODE void fetch_next(const problem<I>& p, unsigned colour, std::size_t k) const {
      if (k + 2 < blocks.size(colour)) order.fetch_ranges(*blocks(colour, k + 2).cells);
      if (k + 1 >= blocks.size(colour)) return;
      const typename half_blocks<D>::unit b = blocks(colour, k + 1);
      for (const std::uint32_t cell : *b.cells) fetch_columns<true>(p, cell);
      for (unsigned row = 0; row < members; row += 3) {
        const auto [cell, part] = pattern::half_block_place<D>[b.part][row];
        order.fetch(order.range((*b.cells)[cell], part));
      }
    }
  };
};

}  // namespace pairsum

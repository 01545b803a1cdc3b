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
        omp_pass(colour, blocks.size(colour), g, probe,
                 [&](std::size_t k) { sum_half_block(p, blocks(colour, k), probe); });
    }

   private:
    template <class Probe>
    PAIRSUM_SAME_CODE void sum_half_block(const problem<I>& p, const typename half_blocks<D>::unit& b, Probe& probe) {
      const cell_range* member[members];
      for (unsigned o = 0; o < members; ++o) {
        unsigned cell = 0, part = 0;
        for (unsigned d = 0, code = o; d < D; ++d, code /= 3) {
          const unsigned at = (b.part >> d & 1) + code % 3;  // half cells from the lower end of the base cell
          cell |= at / 2 << d;
          part |= at % 2 << d;
        }
        member[o] = &order.range((*b.cells)[cell], part);
      }
      for (unsigned j = 0; j < members; ++j) {
        const cell_range& own = *member[j];
        if (own.fluid() == 0) continue;
        range_of_members fluid, boundary;
        const auto& lists = pattern::half_block<D>;
        for (unsigned n = lists.begin[j]; n < lists.begin[j + 1]; ++n) {
          const unsigned k = lists.offset[n];
          const cell_range& other = *member[k];
          if (k > j) fluid.add(other.fluid_begin, other.fluid_end);
          boundary.add(other.boundary_begin, other.boundary_end);
          if constexpr (Probe::counting) {  // as sum_block() counts
            probe.sumF1(k == j);
            probe.sumF2(k != j && other.fluid() + other.boundary() > 0 && (k > j || other.fluid() == 0));
          }
        }
        const auto later = fluid;
        for (std::uint32_t i = own.fluid_begin; i < own.fluid_end; ++i) {
          if (j == 0) {
            fluid = {};
            fluid.add(i + 1, own.fluid_end);
            for (const index_range& r : later) fluid.add(r.begin, r.end);
          }
          scatter(p, i, fluid, boundary, probe);
        }
      }
    }

    /// scatter_one() for number i of the order, with ranges of such numbers.
    template <class Probe>
    [[gnu::always_inline]] void scatter(const problem<I>& p, std::uint32_t i, const range_of_members& fluid,
                                        const range_of_members& boundary, Probe& probe) {
      const positions<D, real> x = order.x();
      const auto x_i = x.point_of(i);
      const auto a = p.fluid.load(order[i]);
      auto u_i = zero<rates_of<I>>();
      const std::size_t n = filter_of<I>::each_in_reach(
          x, x_i, p.reach2, fluid, [&](std::uint32_t k) __attribute__((always_inline)) {
            const vec<D, real> r = x_i - x[k];
            const std::uint32_t j = order[k];
            const auto c = p.formula->pair(r, norm2<D, real>(r), a, p.fluid.load(j));
            add(u_i, c.to_i);
            p.u.add(j, c.to_j);
          });
      if constexpr (Probe::counting) {
        probe.tested(filter_of<I>::size(fluid));
        probe.fluid_pairs(n);
        probe.evaluated(n);
        probe.pairs_of_one(n);
      }
      if constexpr (has_boundary<I>) {
        const std::size_t m = filter_of<I>::each_in_reach(
            x, x_i, p.boundary_reach2, boundary, [&](std::uint32_t k) __attribute__((always_inline)) {
              const vec<D, real> r = x_i - x[k];
              add(u_i, p.formula->boundary(r, norm2<D, real>(r), a, p.boundary_particle(order[k])));
            });
        if constexpr (Probe::counting) {
          probe.tested(filter_of<I>::size(boundary));
          probe.boundary_pairs(m);
          probe.evaluated(m);
        }
      }
      p.u.add(order[i], u_i);
    }
  };
};

}  // namespace pairsum

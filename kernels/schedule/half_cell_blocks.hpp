#pragma once
// The talk's passes on cells of half the cutoff, whose pairs are up to two cells apart:
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
// begin 3 half cells apart and are 3 wide (schedule/half_blocks.hpp); on a torus, whose 2^(M+1) half cells are
// no multiple of 3, those at the seam have their own colours. Bit-identical for every number of threads: neither order
// nor colours depend on it.
#include <pairsum/pattern/half_pattern.hpp>
#include <pairsum/schedule/half_blocks.hpp>
#include <pairsum/schedule/half_cell_order.hpp>

#include <pairsum/sum/schedule.hpp>

namespace pairsum {

template <int D, class R>
class half_cell_blocks final : public schedule<D, R> {
  using P = problem<D, R>;
  static constexpr unsigned members = pattern::stencil_cells<D>;
  static constexpr unsigned at_a_time = 8;  ///< meetings: of more, the first ones would leave the first-level cache

 public:
  static constexpr backend_traits traits{.description = "the talk's passes on cells of half the width",
                                         .aliases = "Newton-3, c08 with a cell size factor of 0.5 (AutoPas)",
                                         .sweeps_per_colour = true,
                                         .loop = {loop_schedule::dynamic, 64},
                                         .cells_per_reach = 2,
                                         .colours = {3, 9, 27}};

  void prepare(const P& p, const team& t) override {
    order_.build(p, p.cells(), p.count, t);
    space_ = order_.space(p);
    blocks_.build(p.cells(), t);
  }
  unsigned colours(const P&) const override { return blocks_.colours(); }
  std::size_t size(const P&, unsigned colour) const override { return blocks_.size(colour); }
  void unit(const P& p, unsigned colour, std::size_t k, int thread) override {
    fetch_next(p, colour, k);
    const typename half_blocks<D>::unit b = blocks_(colour, k);
    const cell_range* of[members];  // member o, at offset o of the pattern from the base
    std::uint32_t have_boundary = 0;
    for (unsigned o = 0; o < members; ++o) {
      const auto [cell, part] = pattern::half_block_place<D>[b.part][o];
      of[o] = &order_.range((*b.cells)[cell], part);
      have_boundary |= of[o]->boundary.size();
    }
    const auto& lists = pattern::half_block<D>;
    meeting<D> some[at_a_time];
    unsigned n = 0;
    for (unsigned j = 0; j < members; ++j) {
      const cell_range& own = *of[j];
      if (own.fluid.size() == 0) continue;
      meeting<D>& m = some[n];
      m.start(own, j == 0 ? partners::later : partners::all);
      for (unsigned l = lists.later[j]; l < lists.begin[j + 1]; ++l) {
        const cell_range& other = *of[lists.offset[l]];
        m.fluid.add(other.fluid);
      }
      if (p.boundary_reach2 > 0 && have_boundary != 0)
        for (unsigned l = lists.begin[j]; l < lists.begin[j + 1]; ++l) {
          const cell_range& other = *of[lists.offset[l]];
          m.boundary.add(other.boundary);
        }
      n += !m.empty();
      if (n < at_a_time) continue;
      sum_meetings<D, R>(p, space_, p.to(thread), some, n);
      n = 0;
    }
    if (p.counts != nullptr) [[unlikely]]
      count_cell_pairs(of, *p.counts);
    sum_meetings<D, R>(p, space_, p.to(thread), some, n);
  }

 private:
  /// Counts as the function for blocks of whole cells does.
  static void count_cell_pairs(const cell_range* const (&of)[members], work_counts& counts) {
    const auto& lists = pattern::half_block<D>;
    for (unsigned j = 0; j < members; ++j) {
      if (of[j]->fluid.size() == 0) continue;
      for (unsigned l = lists.begin[j]; l < lists.begin[j + 1]; ++l) {
        const unsigned k = lists.offset[l];
        const cell_range& other = *of[k];
        counts.sumF1 += k == j;
        counts.sumF2 += k != j && other.fluid.size() + other.boundary.size() > 0 && (k > j || other.fluid.size() == 0);
      }
    }
  }

  /// Prefetches the particles of the block after number k, and where those of a later one are.
  void fetch_next(const P& p, unsigned colour, std::size_t k) const {
    if (k + 2 < blocks_.size(colour)) order_.fetch_ranges(*blocks_(colour, k + 2).cells);
    if (k + 1 >= blocks_.size(colour)) return;
    const typename half_blocks<D>::unit b = blocks_(colour, k + 1);
    p.pairs->fetch(p, b.cells->data(), static_cast<unsigned>(b.cells->size()), &p.u);
    for (unsigned row = 0; row < members; row += 3) {
      const auto [cell, part] = pattern::half_block_place<D>[b.part][row];
      order_.fetch(order_.range((*b.cells)[cell], part));
    }
  }

  half_cell_order<D, R> order_;
  search_space<D, R> space_;
  half_blocks<D> blocks_;
};

}  // namespace pairsum

#pragma once
// A list of pairs with a skin s, kept from step to step (Verlet, Phys. Rev. 159 (1967) 98):
//
//   index, prepare:  if a particle has moved by more than s/2 since the list was made, or there is none:
//                      sort the particles into cells of width H + s;  list = pairs nearer than H + s, each once
//   sum:             for each colour, parallel for blocks of the colour:    as in pair_list_omp
//                      for i in block, for j in row i with |x_i - x_j| < H:
//                        c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
//        H + s  : listed        two particles that are not listed were H + s apart, and each has come nearer by s/2
//        (  H  )  : summed      at most: they are still out of reach
//
// While the list lives particles keep their order, so nothing is sorted. Race-free and bit-identical for every number
// of threads, as pair_list_omp is: rows and blocks are those of the cells the list was made from.
#include <cmath>

#include "sum/backend.hpp"
#include "sum/displacement.hpp"
#include "sum/row_blocks.hpp"

namespace pairsum {

/// Counts cells alone: the tests that count are those of a sum, which makes no list as a rule.
template <class Probe>
struct listing_probe {
  static constexpr bool counting = Probe::counting;
  Probe& probe;
  void sumF1(std::uint64_t n) { probe.sumF1(n); }
  void sumF2(std::uint64_t n) { probe.sumF2(n); }
  void tested(std::uint64_t) {}
  void fluid_pairs(std::uint64_t) {}
  void boundary_pairs(std::uint64_t) {}
};

struct verlet_list {
  static constexpr backend_traits traits{
      .name = "verlet_list",
      .description = "list of pairs with a skin of 0.1 H, kept until a particle has moved half of it; OpenMP",
      .aliases = "Verlet list, half neighbour list with skin (LAMMPS, AutoPas), Newton-3",
      .threads = runtime::omp,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = false,
      .loop = {schedule::dynamic, 1},
      .blocks = true,
      .skin = 0.1,
      .conflicts = conflict_avoidance::colours};

  template <class I>
  class workspace {
    using real = typename I::real;

   public:
    void configure(const setup& s) { listed_.configure(s); }
    std::string block() const { return listed_.block(); }

    /// Does the list still name every pair in reach? The particles must be those, in the order, of the last prepare().
    bool outlasts(const problem<I>& p, const team& t) const {
      if (!serves_) return false;
      // 2 % of the half are for rounding, and what a difference through the faces of a periodic box is rounded by.
      const real limit = real(0.49 * traits.skin) * reach(p) - 2 * p.x.omega.rounding();
      return limit > 0 && moved_.at_most(limit, p.x, p.fluid_count, t);
    }
    /// The particles are, or may be, others, or in another order.
    void expire() { serves_ = false; }
    /// How many lists were made.
    std::size_t lists_made() const { return lists_made_; }

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe& probe) {
      if (serves_) return;
      const real skin = real(traits.skin) * reach(p), far = reach(p) + skin;
      const real boundary = std::sqrt(p.boundary_reach2) + skin;
      listing_probe<Probe> listing{probe};
      listed_.rows.build(p.x, p.cells(), p.fluid_count, far * far,
                         p.boundary_reach2 > 0 ? boundary * boundary : real(0), t, listing);
      listed_.blocks.build(p.cells());
      moved_.since(p.x, p.fluid_count, t);
      serves_ = true;
      ++lists_made_;
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      listed_.each_row(p, t, traits.loop, probe, [&](std::uint32_t i) {
        const pair_rows::row& row = listed_.rows[i];
        scatter_one(p, i, index_list{row.fluid, row.boundary}, index_list{row.boundary, row.end}, probe);
      });
    }

   private:
    static real reach(const problem<I>& p) { return std::sqrt(p.reach2); }

    row_blocks<I> listed_;
    displacement<I::dim, real> moved_;
    bool serves_ = false;
    std::size_t lists_made_ = 0;
  };
};

}  // namespace pairsum

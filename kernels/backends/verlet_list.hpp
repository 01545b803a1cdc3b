#pragma once
// A list of pairs with a skin s, kept from step to step (Verlet, Phys. Rev. 159 (1967) 98):
//
//   index, prepare:  if a particle has moved by more than s/2 since the list was made, or there is none:
//                      sort the particles into cells of width H + s;  list = pairs nearer than H + s, each once
//   sum:             for each colour, parallel for blocks of the colour:    as in pair_list_omp
//                      for i in block, for j in row i:  if |x_i - x_j| < H:  c = f(i, j);  u_i += c.to_i;  u_j +=
//                      c.to_j
//
//        H + s  : listed        two particles that are not listed were H + s apart, and each has come nearer by s/2
//        (  H  )  : summed      at most: they are still out of reach
//
// While the list lives particles keep their order, so nothing is sorted. Race-free and bit-identical for every number
// of threads, as pair_list_omp is: rows and blocks are those of the cells the list was made from.
#include <cmath>

#include "core/omp_loop.hpp"
#include "sum/backend.hpp"
#include "sum/block_setup.hpp"
#include "sum/displacement.hpp"
#include "sum/pair_rows.hpp"

namespace pairsum {

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
    void configure(const setup& s) { shape_blocks(blocks_, s, column_bytes_per_cell<I>()); }
    std::string block() const { return blocks_.shape().word(); }

    /// Does the list still name every pair in reach? The particles must be those, in the order, of the last prepare().
    bool outlasts(const problem<I>& p, const team& t) const {
      // 2 % of the half are for rounding.
      return listed_ && moved_.at_most(real(0.49 * traits.skin) * reach(p), p.x, p.fluid_count, t);
    }
    /// The particles are, or may be, others, or in another order.
    void expire() { listed_ = false; }
    /// How many lists were made.
    std::size_t lists_made() const { return lists_made_; }

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe& probe) {
      if (listed_) return;
      const real skin = real(traits.skin) * reach(p), far = reach(p) + skin;
      const real boundary = std::sqrt(p.boundary_reach2) + skin;
      listing_probe<Probe> listing{probe};
      rows_.build(p.x, p.cells(), p.fluid_count, far * far, p.boundary_reach2 > 0 ? boundary * boundary : real(0), t,
                  listing);
      blocks_.build(p.cells());
      moved_.since(p.x, p.fluid_count, t);
      listed_ = true;
      ++lists_made_;
    }

    template <class Probe>
    void sum(const problem<I>& p, const team& t, Probe& probe) {
      const granularity g = t.granularity_or(traits.loop);
      probe.pass_begins(0);
#pragma omp parallel num_threads(t.threads())
      for (unsigned colour = 0; colour < blocks_.colours(); ++colour)
        omp_pass(colour, blocks_.size(colour), g, probe, [&](std::size_t k) {
          for (const std::uint32_t cell : blocks_(colour, k)) {
            const cell_range& own = p.cells().range[cell];
            for (std::uint32_t i = own.fluid_begin; i < own.fluid_end; ++i) {
              const pair_rows::row& row = rows_[i];
              scatter_one(p, i, index_list{row.fluid, row.boundary}, index_list{row.boundary, row.end}, probe);
            }
          }
        });
    }

   private:
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

    static real reach(const problem<I>& p) { return std::sqrt(p.reach2); }

    pair_rows rows_;
    cell_blocks<I::dim> blocks_;
    displacement<I::dim, real> moved_;
    bool listed_ = false;
    std::size_t lists_made_ = 0;
  };
};

}  // namespace pairsum

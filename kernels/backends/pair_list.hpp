#pragma once
// The list of Liu & Liu ("Smoothed Particle Hydrodynamics", World Scientific 2003, ch. 4):
//
//   prepare:  list = all interacting pairs (i, j), each once, found through the cells
//   sum:      for (i, j) in list:  c = f(i, j);  u_i += c.to_i;  u_j += c.to_j
//
// The list is kept by rows: all partners of i follow each other, so i is stored once. Race-free: one thread.
#include <vector>

#include "sum/backend.hpp"
#include "sum/half_stencil.hpp"

namespace pairsum {

/// The interacting pairs by rows: partners of particle i, fluid ones partner[row[i].fluid .. row[i].boundary), boundary
/// ones from there to row[i+1].fluid.
struct pair_rows {
  struct row_begin {
    std::size_t fluid, boundary;
  };
  column<row_begin> row;
  std::vector<std::uint32_t> partner;

  /// `boundary_reach2` of 0 finds no boundary partners.
  template <int D, class R, class Probe>
  void build(const positions<D, R>& x, const cells<D>& c, std::size_t fluid_count, R reach2, R boundary_reach2,
             Probe& probe) {
    using filter = candidate_filter<D, R>;
    row.resize(fluid_count + 1);
    partner.clear();
    const auto append = [&](std::uint32_t j) { partner.push_back(j); };
    // Fluid is sorted by cell, so the sweep meets particles i = 0, 1, 2, ... in order.
    for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
      sweep_cell(c, cell, probe, [&](std::uint32_t i, const auto& fluid, const auto& boundary) {
        row[i].fluid = partner.size();
        const auto n = filter::each_in_reach(x, x[i], reach2, fluid, append);
        row[i].boundary = partner.size();
        const auto m = boundary_reach2 > 0 ? filter::each_in_reach(x, x[i], boundary_reach2, boundary, append) : 0;
        if constexpr (Probe::counting) {
          probe.tested(filter::size(fluid) + filter::size(boundary));
          probe.fluid_pairs(n);
          probe.boundary_pairs(m);
        }
      });
    row[fluid_count] = {partner.size(), partner.size()};
  }
};

struct pair_list {
  static constexpr backend_traits traits{
      .name = "pair_list",
      .description = "Liu & Liu: list of interacting pairs (prepare), then one serial symmetric sweep (sum)",
      .aliases = "half neighbour list, Verlet list without skin, Newton-3",
      .threads = runtime::serial,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true,
      .evaluations_per_pair = 1,
      .sweeps_per_colour = false,
      .keeps_pairs = true};

  template <class I>
  struct workspace {
    pair_rows list;

    template <class Probe>
    void prepare(const problem<I>& p, const team&, Probe& probe) {
      list.build(p.x, p.cells(), p.fluid_count, p.reach2, p.boundary_reach2, probe);
    }

    template <class Probe>
    void sum(const problem<I>& p, const team&, Probe& probe) {
      using real = typename I::real;
      const auto* const row = list.row.data();
      const std::uint32_t* const partner = list.partner.data();
      if constexpr (Probe::counting) probe.evaluated(list.partner.size());
      for (std::size_t i = 0; i < p.fluid_count; ++i) {
        const auto a = p.fluid.load(i);
        auto u_i = zero<rates_of<I>>();
        either_side(
            p.position(i), [&](const auto& x_i) __attribute__((always_inline)) {
              for (std::size_t k = row[i].fluid; k < row[i].boundary; ++k) {
                const std::uint32_t j = partner[k];
                const vec<I::dim, real> r = x_i - p.position(j);
                const auto c = p.formula->pair(r, norm2<I::dim, real>(r), a, p.fluid.load(j));
                add(u_i, c.to_i);
                p.u.add(j, c.to_j);
              }
              if constexpr (has_boundary<I>)
                for (std::size_t k = row[i].boundary; k < row[i + 1].fluid; ++k) {
                  const std::uint32_t b = partner[k];
                  const vec<I::dim, real> r = x_i - p.position(b);
                  add(u_i, p.formula->boundary(r, norm2<I::dim, real>(r), a, p.boundary_particle(b)));
                }
            });
        p.u.add(i, u_i);
      }
    }
  };
};

}  // namespace pairsum

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

struct pair_list {
  static constexpr backend_traits traits{
      .name = "pair_list",
      .description = "Liu & Liu: list of interacting pairs (prepare), then one serial symmetric sweep (sum)",
      .aliases = "half neighbour list, Verlet list without skin, Newton-3",
      .threads = runtime::serial,
      .symmetric = true,
      .deterministic = true,
      .accumulates = true};

  template <class I>
  struct workspace {
    /// Partners of particle i: fluid partner[row[i].fluid .. row[i].boundary), boundary up to row[i+1].fluid.
    struct row_begin {
      std::size_t fluid, boundary;
    };
    column<row_begin> row;
    std::vector<std::uint32_t> partner;

    template <class Probe>
    void prepare(const problem<I>& p, const team&, Probe& probe) {
      const auto& c = p.cells();
      row.resize(p.fluid_count + 1);
      partner.clear();
      const auto append = [&](std::uint32_t j) { partner.push_back(j); };
      // Fluid is sorted by cell, so the sweep meets particles i = 0, 1, 2, ... in order.
      for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
        sweep_cell<I::dim>(c, cell, probe, [&](std::uint32_t i, const auto& fluid, const auto& boundary) {
          const auto x_i = p.position(i);
          row[i].fluid = partner.size();
          const auto n = candidate_filter<I>::each_in_reach(p, x_i, p.reach2, fluid, append);
          row[i].boundary = partner.size();
          const auto m = candidate_filter<I>::each_in_reach(p, x_i, p.boundary_reach2, boundary, append);
          if constexpr (Probe::counting) {
            probe.tested(candidate_filter<I>::size(fluid) + candidate_filter<I>::size(boundary));
            probe.fluid_pairs(n);
            probe.boundary_pairs(m);
          }
        });
      row[p.fluid_count] = {partner.size(), partner.size()};
    }

    template <class Probe>
    void sum(const problem<I>& p, const team&, Probe&) {
      using real = typename I::real;
      for (std::size_t i = 0; i < p.fluid_count; ++i) {
        const auto x_i = p.position(i);
        const auto a = p.fluid.load(i);
        auto u_i = zero<rates_of<I>>();
        for (std::size_t k = row[i].fluid; k < row[i].boundary; ++k) {
          const std::uint32_t j = partner[k];
          const vec<I::dim, typename I::real> r = x_i - p.position(j);
          const auto c = p.formula->pair(r, norm2<I::dim, real>(r), a, p.fluid.load(j));
          add(u_i, c.to_i);
          p.u.add(j, c.to_j);
        }
        for (std::size_t k = row[i].boundary; k < row[i + 1].fluid; ++k) {
          const std::uint32_t b = partner[k];
          const vec<I::dim, typename I::real> r = x_i - p.position(b);
          add(u_i, p.formula->boundary(r, norm2<I::dim, real>(r), a, p.boundary_particle(b)));
        }
        p.u.add(i, u_i);
      }
    }
  };
};

}  // namespace pairsum

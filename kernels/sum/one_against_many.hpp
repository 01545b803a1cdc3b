#pragma once
#include "sum/candidates.hpp"
#include "sum/probe.hpp"

namespace pairsum {

/// Adds to u_i what the boundary particles of `ranges` do to fluid particle i.
template <class I, class Probe, class Ranges>
[[gnu::always_inline]] inline void add_boundary(const problem<I>& p, std::uint32_t i, const particle_of<I>& a,
                                                const Ranges& ranges, rates_of<I>& u_i, Probe& probe) {
  if constexpr (has_boundary<I>) {
    if (ranges.empty()) return;
    const auto x_i = p.position(i);
    const std::size_t n = filter_of<I>::each_in_reach(
        p.x, x_i, p.boundary_reach2, ranges, [&](std::uint32_t b) __attribute__((always_inline)) {
          const vec<I::dim, typename I::real> r = x_i - p.position(b);
          add(u_i, p.formula->boundary(r, norm2<I::dim, typename I::real>(r), a, p.boundary_particle(b)));
          if constexpr (Probe::counting) probe.evaluated(1);
        });
    if constexpr (Probe::counting) {
      probe.tested(filter_of<I>::size(ranges));
      probe.boundary_pairs(n);
    }
  }
}

/// Symmetric: each fluid pair (i, j in ranges) is computed once and updates both, by u.add(particle, contribution); i's
/// sum stays in registers until the end.
template <class I, class Probe, class Rates, class FluidRanges, class BoundaryRanges>
[[gnu::always_inline]] inline void scatter_one_to(const Rates& u, const problem<I>& p, std::uint32_t i,
                                                  const FluidRanges& fluid, const BoundaryRanges& boundary,
                                                  Probe& probe) {
  const auto x_i = p.position(i);
  const auto a = p.fluid.load(i);
  auto u_i = zero<rates_of<I>>();
  const std::size_t n = filter_of<I>::each_in_reach(
      p.x, x_i, p.reach2, fluid, [&](std::uint32_t j) __attribute__((always_inline)) {
        const vec<I::dim, typename I::real> r = x_i - p.position(j);
        const auto c = p.formula->pair(r, norm2<I::dim, typename I::real>(r), a, p.fluid.load(j));
        add(u_i, c.to_i);
        u.add(j, c.to_j);
        if constexpr (Probe::counting) probe.evaluated(1);
      });
  if constexpr (Probe::counting) {
    probe.tested(filter_of<I>::size(fluid));
    probe.fluid_pairs(n);
    probe.pairs_of_one(n);
  }
  add_boundary(p, i, a, boundary, u_i, probe);
  u.add(i, u_i);
}

/// scatter_one_to() the rates themselves.
template <class I, class Probe, class FluidRanges, class BoundaryRanges>
[[gnu::always_inline]] inline void scatter_one(const problem<I>& p, std::uint32_t i, const FluidRanges& fluid,
                                               const BoundaryRanges& boundary, Probe& probe) {
  scatter_one_to(p.u, p, i, fluid, boundary, probe);
}

/// Gather: fluid particle i collects its own side from every neighbour; nothing else is written. A pair is seen twice,
/// so the probe counts it by its side with j < i.
template <class I, class Probe, class FluidRanges, class BoundaryRanges>
[[gnu::always_inline]] inline void gather_one(const problem<I>& p, std::uint32_t i, const FluidRanges& fluid,
                                              const BoundaryRanges& boundary, Probe& probe) {
  const auto x_i = p.position(i);
  const auto a = p.fluid.load(i);
  auto u_i = zero<rates_of<I>>();
  [[maybe_unused]] const std::size_t n = filter_of<I>::each_in_reach(
      p.x, x_i, p.reach2, fluid, [&](std::uint32_t j) __attribute__((always_inline)) {
        const vec<I::dim, typename I::real> r = x_i - p.position(j);
        add(u_i, p.formula->pair(r, norm2<I::dim, typename I::real>(r), a, p.fluid.load(j)).to_i);
        if constexpr (Probe::counting) {
          probe.fluid_pairs(j < i);
          probe.evaluated(1);
        }
      });
  if constexpr (Probe::counting) {
    probe.tested(filter_of<I>::size(fluid));
    probe.pairs_of_one(n);
  }
  add_boundary(p, i, a, boundary, u_i, probe);
  p.u.store(i, u_i);
}

}  // namespace pairsum

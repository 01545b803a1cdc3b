#pragma once
#include <string_view>

#include "sum/backend.hpp"
#include "sum/block.hpp"
#include "sum/summation_of.hpp"

// Backends that are wrong in one pair, to show that verification rejects them: the talk's passes,
// serial and plain, with a fault planted in the first fluid pair they meet whose contribution to j
// is not zero.
namespace pairsum {

enum class fault {
  none,         ///< correct: must pass
  drop_pair,    ///< the pair is left out
  double_pair,  ///< the pair is summed twice
  flip_sign,    ///< the contribution to j has the wrong sign
};

constexpr std::string_view name_of(fault f) {
  return f == fault::none          ? "broken_none"
         : f == fault::drop_pair   ? "broken_drop_pair"
         : f == fault::double_pair ? "broken_double_pair"
                                   : "broken_flip_sign";
}

template <fault F>
struct broken_symmetric {
  static constexpr backend_traits traits{.name = name_of(F),
                                         .description = "for tests: wrong in one pair",
                                         .aliases = "",
                                         .threads = runtime::serial,
                                         .symmetric = true,
                                         .deterministic = true,
                                         .accumulates = true,
                                         .evaluations_per_pair = 1,
                                         .sweeps_per_colour = true,
                                         .keeps_pairs = false};

  template <class I>
  struct workspace {
    using real = typename I::real;
    using difference = vec<I::dim, real>;
    coloured_blocks<I::dim> blocks;
    bool planted = false;

    template <class Probe>
    void prepare(const problem<I>& p, const team& t, Probe&) {
      blocks.build(p.cells(), t);
    }

    template <class Probe>
    void sum(const problem<I>& p, const team&, Probe& probe) {
      planted = false;
      const auto& range = p.cells().range;
      for (unsigned o = 0; o < coloured_blocks<I::dim>::colours; ++o)
        for (const auto& b : blocks[o]) {
          sum_cells(p, range[b[0]], range[b[0]], true, probe);
          for (const auto& [j, k] : pattern::block_pairs<I::dim>) {
            sum_cells(p, range[b[j]], range[b[k]], false, probe);
          }
        }
    }

   private:
    /// sumF1 (one cell, `same`) or sumF2 (two cells).
    template <class Probe>
    void sum_cells(const problem<I>& p, const cell_range& a, const cell_range& b, bool same, Probe& probe) {
      for (auto i = a.fluid_begin; i < a.fluid_end; ++i)
        for (auto j = same ? i + 1 : b.fluid_begin; j < b.fluid_end; ++j) fluid_pair(p, i, j, probe);
      sum_walls(p, a, b, probe);
      if (!same) sum_walls(p, b, a, probe);
    }

    template <class Probe>
    void fluid_pair(const problem<I>& p, std::uint32_t i, std::uint32_t j, Probe& probe) {
      probe.tested(1);
      const difference r = p.position(i) - p.position(j);
      const real r2 = norm2<I::dim, real>(r);
      if (!(r2 < p.reach2)) return;
      probe.fluid_pairs(1);
      probe.evaluated(1);
      auto c = p.formula->pair(r, r2, p.fluid.load(i), p.fluid.load(j));
      if (!planted && F != fault::none && acts(c.to_j)) {
        planted = true;
        if constexpr (F == fault::drop_pair) return;
        if constexpr (F == fault::flip_sign) each_scalar(c.to_j, [](auto& a, int) { a = 0 - a; });
        if constexpr (F == fault::double_pair) {
          p.u.add(i, c.to_i);
          p.u.add(j, c.to_j);
        }
      }
      p.u.add(i, c.to_i);
      p.u.add(j, c.to_j);
    }

    template <class Probe>
    void sum_walls(const problem<I>& p, const cell_range& fluid, const cell_range& wall, Probe& probe) {
      for (auto i = fluid.fluid_begin; i < fluid.fluid_end; ++i)
        for (auto b = wall.boundary_begin; b < wall.boundary_end; ++b) {
          probe.tested(1);
          const difference r = p.position(i) - p.position(b);
          const real r2 = norm2<I::dim, real>(r);
          if (!(r2 < p.boundary_reach2)) continue;
          probe.boundary_pairs(1);
          probe.evaluated(1);
          p.u.add(i, p.formula->boundary(r, r2, p.fluid.load(i), p.boundary_particle(b)));
        }
    }

    static bool acts(rates_of<I> u) {
      bool any = false;
      each_scalar(u, [&](auto& a, int) { any = any || a != 0; });
      return any;
    }
  };
};

}  // namespace pairsum

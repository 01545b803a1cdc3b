#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "core/isa.hpp"
#include "core/names.hpp"
#include "core/team.hpp"
#include "sum/block_setup.hpp"
#include "sum/gather_cell.hpp"
#include "sum/scatter_cell.hpp"
#include "sum/setup.hpp"
#include "vector/tile_problem.hpp"

namespace pairsum {

/// What tile backends keep from step to step: the fluid as rows, the blocks, and the kernel of the instruction set.
/// Pairs that lanes do not carry (of whole numbers, or where nothing is compiled for vector units) are summed one at a
/// time, in the same order of cells.
template <class I, bool symmetric>
class tile_workspace {
  using tiles = tile_problem<I>;
  using real = typename tiles::real;
  using value = typename tiles::value;
  static constexpr std::size_t spare_rows = 16;             ///< per thread: as many as the widest vector has lanes
  static constexpr std::size_t most_in_float = 0x7fffffff;  ///< numbers of particles are lanes as wide as values
  static constexpr std::size_t row_bytes = tiles::stride * sizeof(value);
  /// In a world narrower than this, in reaches, what the test lets pass is near. In a wider one places coincide, so all
  /// pairs of whole-number rows (mixed) are decided one by one. (In a periodic box only those of a particle do, but
  /// they may be coarse.)
  static constexpr double unfolded = 2000;
  static constexpr double turn = 4294967296;  ///< of whole numbers modulo 2^32

 public:
  /// Does this workspace derive what fluid particles bring to a pair?
  bool derives_fluid() const { return kernel_ != nullptr; }

  /// Throws pairsum::error for an isa or a block that is not to be had.
  void configure(const setup& s) {
    shape_blocks(blocks_, s, bytes_per_cell(s.dim), !symmetric);
    check_isa(s.isa);
    excess_ = excess_in(s);
    for (int d = 0; d < I::dim; ++d) {
      const double edge = s.omega_high[d] - s.omega_low[d];
      mixed_unit_[d] = s.periodic ? mixed_unit(s.constants.H, edge) : mixed_unit(s.constants.H);
    }
    const bool all_are_near = s.periodic ? excess_ < 8 : widest(s) < unfolded;
    tie_ = !is_mixed<I> || all_are_near ? 16 * std::numeric_limits<value>::epsilon()
                                        : std::numeric_limits<value>::infinity();
    if constexpr (takes_lanes<I>) {
      const auto kernels = vector_kernels<I>();
      for (const tile_kernels<I>& k : kernels)
        if (!kernel_ && (s.isa == best_isa || k.isa == s.isa)) {
          kernel_ = symmetric ? k.symmetric : k.gather;
          lanes_ = k.lanes;
          rounds_alike_ = !is_mixed<I> && (I::dim == 1 || k.fuses == scalar_fuses);
        }
      if (!kernel_ && !kernels.empty())
        throw error("interaction " + std::string(I::name) + " was not compiled for isa " + s.isa +
                    "; one of one's own is compiled for one set, by the flags of its source: take isa best");
    }
  }

  template <class Probe>
  void prepare(const problem<I>& p, const team& t, Probe&) {
    const std::size_t spare = spare_rows * static_cast<std::size_t>(t.threads());
    if (kernel_ && sizeof(value) == 4 && p.count + spare > most_in_float)
      throw error("vector backends take at most 2^31 - 1 particles in float or mixed precision, got " +
                  std::to_string(p.count));
    threads_ = t.threads();
    rows_are_zero_ = false;
    blocks_.build(p.cells());
    if (kernel_) {
      rows_.resize((p.fluid_count + spare) * row_bytes);
      const tiles view = view_of(p);
      t.for_pieces(p.fluid_count, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) fill(view, i, mixed_unit_);
      });
      for (auto& column : place_) column.resize(p.count + place_room);
      t.for_pieces(p.count, [&](std::size_t begin, std::size_t end, std::size_t) { fill_places(p, begin, end); });
      for (std::size_t i = p.fluid_count; i < p.fluid_count + spare; ++i) {
        std::fill_n(view.row(i), tiles::rates_at, std::numeric_limits<value>::quiet_NaN());
        std::fill_n(view.rates_of_row(i), padded(tiles::rates), real(0));
      }
      rows_are_zero_ = true;
    }
  }

  /// The rates to 0: those of rows, which are 0 from prepare() on until they are summed, or of gathers, which add to
  /// the columns.
  void zero(const problem<I>& p, const team& t) {
    if (symmetric && kernel_ && rows_are_zero_) return;
    const tiles view = view_of(p);
    t.for_pieces(p.fluid_count, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) {
        if (symmetric && kernel_)
          std::fill_n(view.rates_of_row(i), tiles::rates, real(0));
        else
          p.u.store(i, pairsum::zero<rates_of<I>>());
      }
    });
  }

  /// To be called before the first block of a sum. Every thread needs spare rows: throws pairsum::error for a team
  /// larger than that of prepare().
  void begin_sum(const team& t) {
    check_prepared(threads_, t);
    rows_are_zero_ = false;
  }

  /// Sums the cells of a block on thread `thread` of the team.
  template <class Probe>
  void sum_block(const problem<I>& p, unsigned colour, std::size_t block, int thread, Probe& probe) {
    const auto cell = blocks_(colour, block);
    if (kernel_) {
      kernel_(view_of(p), cell.data(), cell.size(),
              static_cast<std::uint32_t>(p.fluid_count + spare_rows * static_cast<std::size_t>(thread)));
    } else {
      for (const std::uint32_t c : cell) sum_scalar(p, c, probe);
    }
  }

  /// Brings the rates of rows to the columns.
  void reduce(const problem<I>& p, const team& t) {
    const tiles view = view_of(p);
    if (symmetric && kernel_)
      t.for_pieces(p.fluid_count, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
          for (std::size_t s = 0; s < tiles::rates; ++s)
            p.u.template column_as<real>(static_cast<int>(s))[i] = view.rates_of_row(i)[s];
      });
  }

  std::size_t lanes() const { return lanes_; }
  std::string block() const { return blocks_.shape().word(); }
  unsigned colours() const { return blocks_.colours(); }
  std::size_t blocks(unsigned colour) const { return blocks_.size(colour); }

 private:
#ifdef __FP_FAST_FMA
  static constexpr bool scalar_fuses = true;
#else
  static constexpr bool scalar_fuses = false;
#endif
  static bool in_reach(const problem<I>& p, std::uint32_t i, std::uint32_t j, real reach2) {
    return norm2<I::dim, real>(p.position(i) - p.position(j)) < reach2;
  }

  /// Bytes of a cell's particles, at the talk's spacing of H/2.
  static std::size_t bytes_per_cell(int dim) {
    return (std::size_t{1} << dim) * (row_bytes + I::dim * sizeof(std::int32_t));
  }

  tiles view_of(const problem<I>& p) {
    tiles view{};
    view.p = &p;
    for (int d = 0; d < I::dim; ++d) view.place[d] = place_[d].data();
    view.excess = excess_;
    view.periodic = p.x.omega.periodic;
    for (int d = 0; d < I::dim && view.periodic; ++d) {
      const double edge = p.x.omega.edge[d] / reach(p) * places_per_reach;
      view.place_size[d] = static_cast<float>(edge / turn);
      view.half_edge[d] = static_cast<float>(edge / 2);
    }
    view.rows = rows_.data();
    for (int d = 0; d < I::dim; ++d) view.mixed_unit[d] = static_cast<value>(mixed_unit_[d]);
    view.in_reach = rounds_alike_ ? nullptr : &in_reach;
    view.tie = tie_;
    return view;
  }

  static void fill(const tiles& view, std::size_t i, const std::array<double, I::dim>& unit) {
    const problem<I>& p = *view.p;
    const auto& set = *p.particles;
    const particle_state<I::dim, real> state{set.position(i), set.velocity(i), set.rho[i], set.m[i], set.id[i]};
    value* const row = view.row(i);
    for (int d = 0; d < I::dim; ++d) {
      if constexpr (is_mixed<I>)
        row[d] = std::bit_cast<value>(modulo_2_32((state.x[d] - (view.periodic ? p.x.column[d][0] : 0)) / unit[d]));
      else
        row[d] = state.x[d];
    }
    each_scalar(p.formula->derive(state), [&](const real& a, int k) { row[I::dim + k] = static_cast<value>(a); });
    if constexpr (symmetric) std::fill_n(view.rates_of_row(i), tiles::rates, real(0));
  }

  /// Omega's longest edge, in units of the reach.
  static double widest(const setup& s) {
    double longest = 0;
    for (std::size_t d = 0; d < s.omega_low.size(); ++d) longest = std::max(longest, s.omega_high[d] - s.omega_low[d]);
    return longest / s.constants.H;
  }

  /// Rounding to places moves a component of x_i - x_j by up to one of them, and by what doubles cannot hold of it in a
  /// world as wide as Omega. In a periodic box places are as fine as its edge allows, sizes of places are rounded, and
  /// so are, in the working precision, differences as large as the edge.
  static float excess_in(const setup& s) {
    double component = 1.0 / places_per_reach + widest(s) * 0x1p-51;  // in units of the reach
    if (s.periodic) component += widest(s) * (1.01 / turn + std::numeric_limits<real>::epsilon());
    return static_cast<float>(2 * std::sqrt(3.0) * component + 3 * component * component);
  }

  static double reach(const problem<I>& p) { return std::sqrt(static_cast<double>(p.reach2)); }
  /// From the first particle, so that a world far from 0 keeps its digits. The edge of a periodic box is 2^32.
  void fill_places(const problem<I>& p, std::size_t begin, std::size_t end) {
    if (begin == end) return;
    for (int d = 0; d < I::dim; ++d) {
      const real* const x = p.x.column[d];
      const double first = x[0], scale = p.x.omega.periodic ? turn / p.x.omega.edge[d] : places_per_reach / reach(p);
      for (std::size_t i = begin; i < end; ++i) place_[d][i] = modulo_2_32((static_cast<double>(x[i]) - first) * scale);
    }
  }
  /// x, rounded to a whole number, modulo 2^32, whatever its size: no rounding but the last.
  static std::int32_t modulo_2_32(double x) {
    const double rest = std::floor(x - std::floor(x * (1 / turn) + 0.5) * turn + 0.5);  // in [-2^31, 2^31]
    // Where doubles are coarser than 2^32 places, any number will do that is the same for the same x.
    return static_cast<std::int32_t>(
        static_cast<std::uint32_t>(static_cast<std::int64_t>(std::abs(rest) <= turn ? rest : 0)));
  }

  template <class Probe>
  void sum_scalar(const problem<I>& p, std::size_t cell, Probe& probe) {
    if constexpr (symmetric) {
      scatter_cell(p, cell, probe);
    } else {
      gather_cell(p, cell, probe);
    }
  }

  column<std::byte> rows_;
  std::array<column<std::int32_t>, I::dim> place_;
  cell_blocks<I::dim> blocks_;
  tile_function<I> kernel_ = nullptr;
  std::size_t lanes_ = 1;
  std::array<double, I::dim> mixed_unit_{};
  float excess_ = 0;
  value tie_ = 0;
  bool rounds_alike_ = true;
  int threads_ = 0;
  bool rows_are_zero_ = false;
};

}  // namespace pairsum

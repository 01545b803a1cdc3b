#pragma once
#include <array>

#include <pairsum/core/column.hpp>
#include <pairsum/core/team.hpp>
#include <pairsum/sum/problem.hpp>
#include <pairsum/sum/setup.hpp>
#include <pairsum/sum/vector_lister.hpp>

namespace pairsum {

/// How a formula's particles lie as rows: position and fields, then, from rates_at on, the rates. In bytes.
struct lane_layout {
  std::size_t rates_at = 0, stride = 0;
  std::size_t value = 0;         ///< of a value
  bool mixed = false;            ///< values are float, sums double
  std::size_t column_bytes = 0;  ///< of a particle without rows: position, fields and rates in columns
  double boundary_reach = 0;     ///< cutoff of the boundary, in units of H
};

/// What vector units read of the fluid besides positions for the search: a row with all data of a particle, so that a
/// partner is loaded whole. For the talk's formula in 3D and double a row is two cache lines. Rows behind the fluid,
/// some for each thread, are beyond every cutoff: lanes without a particle point there.
///
/// Values are of the pairs' precision, rates of the sums'. Where these differ (mixed) a component of a position is a
/// whole number of mixed_unit modulo 2^32, kept in the bits of a value.
template <int D, class R>
struct lane_view {
  std::byte* rows = nullptr;           ///< on 64-byte boundaries
  bool periodic = false;               ///< along any axis
  std::array<R, D> origin{};           ///< m: of mixed positions
  std::array<double, D> mixed_unit{};  ///< m: what mixed positions are counted in
  /// Decides r^2 < reach2 for particles i and j as scalar code does; nullptr if lanes round alike. One of the two may
  /// fuse products and sums (see fused()) and the other not, or be more precise (mixed), which matters for pairs within
  /// rounding of the cutoff: those with |r^2 - reach2| < tie * reach2, which is all of them if tie is infinite.
  bool (*in_reach)(const positions<D, R>& x, std::uint32_t i, std::uint32_t j, R reach2) = nullptr;
  double tie = 0;
};

/// What vector units must allow for rounding, from the setup alone.
struct lane_tolerances {
  /// How far rounding to places moves |x_i - x_j|^2, in units of the cutoff squared. A component of x_i - x_j is moved
  /// by up to one place, and by what doubles cannot hold of it in a domain of that width. Along a periodic axis places
  /// are as fine as its edge allows, sizes of places are rounded, and so are, in the working precision, differences as
  /// large as the edge.
  float excess = 0;
  /// See lane_view. 16 units in the last place cover the roundings of r^2. Along an open axis wider than 2000 cutoffs
  /// places coincide, so all pairs of whole-number rows (mixed) are decided one by one. (Along a periodic one only
  /// those of a particle do, but they may be coarse.)
  double tie = 0;
  std::array<double, 3> mixed_unit{};  ///< m, per axis

  /// `u`: relative spacing of the working precision, `value_u`: of values; `cutoff`: of lists, m.
  static lane_tolerances of(const setup& s, double cutoff, bool mixed, double u, double value_u);
};

/// The fluid as rows, and the places of all particles.
template <int D, class R>
class lane_rows {
 public:
  static constexpr std::size_t spare_rows = row_padding;  ///< per thread

  /// `skin`: of lists, in units of H.
  lane_rows(const setup& s, const lane_layout& layout, bool lanes_fuse, double skin);

  /// Makes room for rows, fills places, and lets the problem point to both; the formula then fills the fluid's rows,
  /// rates of 0 among them.
  void prepare(problem<D, R>& p, const team& t);
  const lane_view<D, R>& view() const { return view_; }

 private:
  void fill_places(const problem<D, R>& p, std::size_t begin, std::size_t end);

  lane_layout layout_;
  double cutoff_, boundary_reach_;
  float excess_;
  lane_view<D, R> view_;
  column<std::byte> rows_;
  std::array<column<std::int32_t>, D> place_;
  void* rates_begin_ = nullptr;
};

}  // namespace pairsum

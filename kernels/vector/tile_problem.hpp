#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/isa.hpp"
#include "sum/mixed.hpp"
#include "sum/problem.hpp"

namespace pairsum {

/// Rows are read in blocks of so many values.
inline constexpr std::size_t row_block = 4;

/// n values, padded to whole blocks.
constexpr std::size_t padded(std::size_t n) { return (n + row_block - 1) / row_block * row_block; }

/// Has a vector of lanes of R the same fields as S, so that formulas take it?
template <class S, class R>
constexpr bool made_of() {
  if constexpr (fields_detail::is_struct<S>)
    return []<class... P>(std::tuple<P...>) {
      return (std::is_same_v<typename fields_detail::member<P>::type::scalar, R> && ...);
    }(S::fields());
  else
    return std::is_same_v<typename fields_detail::field<S>::scalar, R>;
}

/// Do lanes carry everything interaction I brings to a pair and takes from it? Whole numbers are summed one pair at a
/// time.
template <class I>
inline constexpr bool takes_lanes =
    made_of<particle_of<I>, typename I::real>() && made_of<boundary_particle_of<I>, typename I::real>() &&
    made_of<rates_of<I>, typename I::real>();

/// Places are whole numbers modulo 2^32, so many to a reach: differences of particles less than 2048 reaches apart are
/// exact. In a periodic box 2^32 of them make its edge, so that differences go through its faces where that is shorter.
inline constexpr std::int32_t places_per_reach = 1 << 20;
/// Columns of places can be read so far behind their end.
inline constexpr std::size_t place_room = 32;

/// What a vector kernel sees: the problem, the places of all particles, and the fluid once more as rows, so that a
/// particle that was found is loaded whole: its position and the fields it brings to a pair, then, from `rates_at` on,
/// its rates. For the talk's formula in 3D and double that makes two cache lines. The rows behind the fluid, some for
/// each thread, are in reach of nothing: lanes without a particle point there.
///
/// Values are of the pairs' precision, rates of the sums'. Where these differ (mixed) a component of a position is a
/// whole number of mixed_unit modulo 2^32, kept in the bits of a value.
template <class I>
struct tile_problem {
  using real = typename I::real;
  using value = pair_real<I>;
  static constexpr std::size_t values = I::dim + field_count<particle_of<I>>, rates = field_count<rates_of<I>>;
  static constexpr std::size_t value_per_rate = sizeof(real) / sizeof(value);
  static constexpr std::size_t rates_at = padded(values);                           ///< in values
  static constexpr std::size_t stride = rates_at + value_per_rate * padded(rates);  ///< in values
  static constexpr std::size_t rates_stride = stride / value_per_rate;              ///< in rates
  static_assert(stride % value_per_rate == 0 && rates_at * sizeof(value) % alignof(real) == 0);

  const problem<I>* p;
  std::array<const std::int32_t*, I::dim> place;  ///< [particle]; rounded to the nearest
  float excess;  ///< how far, in units of the reach squared, rounding to places can move |x_i - x_j|^2
  bool periodic;
  std::array<float, I::dim> place_size;  ///< of a periodic box: units of 2^-20 reaches that a place takes, per axis
  std::array<float, I::dim> half_edge;   ///< half its edges in such units
  std::byte* rows;                       ///< [particle][stride], on 64-byte boundaries
  std::array<value, I::dim> mixed_unit;  ///< m: what positions of mixed rows are counted in, per axis
  /// Decides r^2 < reach2 for particles i and j as scalar code does; nullptr if lanes round alike. One of the two may
  /// fuse products and sums (see fused()) and the other not, or be more precise (mixed), which matters for pairs within
  /// rounding of the reach: those with |r^2 - reach2| < tie * reach2, which is all of
  /// them if tie is infinite.
  bool (*in_reach)(const problem<I>& p, std::uint32_t i, std::uint32_t j, real reach2);
  value tie;

  [[gnu::always_inline]] value* row(std::size_t i) const { return reinterpret_cast<value*>(rows) + i * stride; }
  [[gnu::always_inline]] real* rates_of_row(std::size_t i) const { return reinterpret_cast<real*>(row(i) + rates_at); }
};

/// Sums the cells `cell[0..n)`: their fluid with the forward half of their neighbours, both sides (symmetric), or with
/// all of them, their own side (gather). `spare` is the number of the caller's first row behind the
/// fluid, of as many as a vector has lanes.
template <class I>
using tile_function = void (*)(const tile_problem<I>&, const std::uint32_t* cell, std::size_t n, std::uint32_t spare);

/// The kernels of one instruction set.
template <class I>
struct tile_kernels {
  std::string_view isa;
  std::size_t lanes;  ///< pairs in a vector
  bool fuses;         ///< rounds a*b + c once
  tile_function<I> symmetric, gather;
};

/// The kernels for interaction I that this machine runs, best first. The library's own interactions have them for every
/// set of isa_names(), compiled apart; for those of one's own vector/vector_kernels.hpp, which sum/all_backends.hpp
/// includes, makes those of the flags the source is compiled with.
template <class I>
std::vector<tile_kernels<I>> vector_kernels();

/// An instruction set and what makes its kernels.
template <class I>
struct kernel_maker {
  std::string_view isa;
  tile_kernels<I> (*make)();
};

/// The kernels of those sets that this machine runs, best first.
template <class I>
std::vector<tile_kernels<I>> kernels_that_run(const std::vector<kernel_maker<I>>& built) {
  std::vector<tile_kernels<I>> all;
  for (const std::string_view isa : isa_names())
    for (const kernel_maker<I>& k : built)
      if (k.isa == isa) {
        all.push_back(k.make());
        all.back().isa = isa;
      }
  return all;
}

}  // namespace pairsum

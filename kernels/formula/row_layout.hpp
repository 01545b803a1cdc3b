#pragma once
#include <pairsum/formula/mixed.hpp>
#include <pairsum/interactions/interaction.hpp>
#include <pairsum/sum/lane_rows.hpp>

namespace pairsum {

/// Rows are read in blocks of so many values.
inline constexpr std::size_t row_block = 4;

/// n values, padded to whole blocks.
constexpr std::size_t padded(std::size_t n) { return (n + row_block - 1) / row_block * row_block; }

namespace row_detail {
/// Has S the fields of a vector of lanes of R?
template <class S, class R>
constexpr bool made_of() {
  if constexpr (fields_detail::is_struct<S>)
    return []<class... P>(std::tuple<P...>) {
      return (std::is_same_v<typename fields_detail::member<P>::type::scalar, R> && ...);
    }(S::fields());
  else
    return std::is_same_v<typename fields_detail::field<S>::scalar, R>;
}
}  // namespace row_detail

/// Can lanes hold all data and rates of interaction I? Whole numbers are summed one pair at a time.
template <class I>
inline constexpr bool takes_lanes = row_detail::made_of<particle_of<I>, typename I::real>() &&
                                    row_detail::made_of<boundary_particle_of<I>, typename I::real>() &&
                                    row_detail::made_of<rates_of<I>, typename I::real>();

/// A particle of I as a row: its position and the fields that a pair needs, then, from rates_at on, its rates.
template <class I>
struct row_layout {
  using real = typename I::real;
  using value = pair_real<I>;
  static constexpr std::size_t values = I::dim + field_count<particle_of<I>>, rates = field_count<rates_of<I>>;
  static constexpr std::size_t value_per_rate = sizeof(real) / sizeof(value);
  static constexpr std::size_t rates_at = padded(values);                           ///< in values
  static constexpr std::size_t stride = rates_at + value_per_rate * padded(rates);  ///< in values
  static constexpr std::size_t bytes = stride * sizeof(value);
  static_assert(rates_at * sizeof(value) % alignof(real) == 0);
};

/// The same as numbers.
template <class I>
lane_layout layout_of() {
  using layout = row_layout<I>;
  using real = typename I::real;
  lane_layout l;
  l.rates_at = layout::rates_at * sizeof(typename layout::value);
  l.stride = layout::bytes;
  l.value = sizeof(typename layout::value);
  l.mixed = is_mixed<I>;
  l.boundary_reach = pairsum::boundary_reach<I>();
  l.column_bytes = (layout::values + layout::rates) * sizeof(real);
  return l;
}

}  // namespace pairsum

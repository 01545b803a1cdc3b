#pragma once
#include <string_view>
#include <type_traits>

#include <pairsum/core/places.hpp>

namespace pairsum {

/// The working precision's name, as on the command line and in the rows.
template <class R>
constexpr std::string_view precision_name();
template <>
constexpr std::string_view precision_name<double>() {
  return "double";
}
template <>
constexpr std::string_view precision_name<float>() {
  return "float";
}

/// The name of what is neither: state and sums in double, pairs in float (sum/mixed.hpp).
inline constexpr std::string_view mixed_precision = "mixed";

/// Does this build hold the dimension D in working precision R?
template <int D, class R>
constexpr bool is_place() {
#define PAIRSUM_IS_IT(d, r) ((d) == D && std::is_same_v<r, R>) ||
  return PAIRSUM_EACH_D_R(PAIRSUM_IS_IT) false;
#undef PAIRSUM_IS_IT
}

/// f.operator()<dim, single ? float : double>(), or an empty result if this build does not hold that.
template <class F>
auto at_place(int dim, bool single, F&& f) -> decltype(f.template operator()<3, double>()) {
#define PAIRSUM_AT(D, R) \
  if (dim == (D) && single == std::is_same_v<R, float>) return f.template operator()<D, R>();
  PAIRSUM_EACH_D_R(PAIRSUM_AT)
#undef PAIRSUM_AT
  return {};
}

}  // namespace pairsum

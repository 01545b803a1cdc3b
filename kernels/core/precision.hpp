#pragma once
#include <string_view>

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

}  // namespace pairsum

#pragma once
#include <vector>

#include <pairsum/sum/formula.hpp>

namespace pairsum {

/// Precisions as types; double and float are no names.
namespace precisions {
struct in_double {
  static constexpr std::string_view name = "double";
};
struct in_float {
  static constexpr std::string_view name = "float";
};
struct in_mixed {
  static constexpr std::string_view name = "mixed";
};
}  // namespace precisions

/// Where a source in formulas/ is compiled: `formulas_of_<word>(place, to)` appends what it holds.
template <int D, class Precision>
struct place {};

}  // namespace pairsum

#define PAIRSUM_EACH_PLACE(DO, word) \
  DO(word, 1, in_double)             \
  DO(word, 2, in_double)             \
  DO(word, 3, in_double)             \
  DO(word, 1, in_float)              \
  DO(word, 2, in_float) DO(word, 3, in_float) DO(word, 1, in_mixed) DO(word, 2, in_mixed) DO(word, 3, in_mixed)

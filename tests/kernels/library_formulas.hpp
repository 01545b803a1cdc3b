#pragma once
#include <pairsum/core/error.hpp>
#include <pairsum/formula/words.hpp>

namespace pairsum {

#define PAIRSUM_DECLARE_FORMULAS(word, D, precision) \
  void formulas_of_##word(place<D, precisions::precision>, std::vector<formula_entry>&);
PAIRSUM_EACH_PLACE(PAIRSUM_DECLARE_FORMULAS, ferrari09)
PAIRSUM_EACH_PLACE(PAIRSUM_DECLARE_FORMULAS, count)
#undef PAIRSUM_DECLARE_FORMULAS

/// Formulas of the library on their own, not compiled again: for registries with other backends, and for schedules
/// without a registry.
namespace test_kit {

inline formula_entry ferrari09_3d() {
  std::vector<formula_entry> all;
  formulas_of_ferrari09(place<3, precisions::in_double>(), all);
  for (const formula_entry& f : all)
    if (f.words.smoothing == "wendland_c2") return f;
  throw error("wendland_c2 is not built");
}

template <int D>
formula_entry counting_formula() {
  std::vector<formula_entry> all;
  formulas_of_count(place<D, precisions::in_double>(), all);
  return all.at(0);
}

}  // namespace test_kit
}  // namespace pairsum

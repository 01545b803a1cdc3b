#pragma once
#include <pairsum/core/precision.hpp>
#include <pairsum/formula/formula_of.hpp>
#include <pairsum/reference/reference_of.hpp>

namespace pairsum {

/// The words for interaction I.
template <class I>
constexpr combination_words words_of() {
  combination_words w{I::name, "", I::dim, precision_of<I>()};
  if constexpr (requires { typename I::smoothing; }) w.smoothing = I::smoothing::name;
  return w;
}

/// Interaction I for a registry: with every backend, on the vector units that this source is compiled for, and with its
/// reference.
template <interaction I>
formula_entry formula_entry_of() {
  static_assert(is_place<I::dim, typename I::real>(),
                "this build of the library leaves out I::dim or I::real: see PAIRSUM_DIMS and PAIRSUM_PRECISIONS");
  return {words_of<I>(),
          [](const setup& s) -> std::unique_ptr<any_formula> { return std::make_unique<formula_of<I>>(s); },
          [](const setup& s) -> std::unique_ptr<reference> { return std::make_unique<reference_of<I>>(s); }};
}

}  // namespace pairsum

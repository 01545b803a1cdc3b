#pragma once
#include <memory>

#include "sum/mixed.hpp"
#include "sum/registry.hpp"
#include "sum/summation_of.hpp"

namespace pairsum {

/// The words for interaction I.
template <class I>
constexpr combination_words words_of() {
  combination_words w{I::name, "", I::dim, precision_of<I>()};
  if constexpr (requires { typename I::smoothing; }) w.smoothing = I::smoothing::name;
  return w;
}

/// Enrols backend B with interaction I, unless I is for vector backends alone.
template <class B, class I>
void enrol_summation(registry& r) {
  if constexpr (B::traits.vector || !is_mixed<I>)
    r.enrol(B::traits.name, words_of<I>(),
            [](const setup& s) { return std::unique_ptr<summation>(new summation_of<B, I>(s)); });
}

}  // namespace pairsum

#pragma once
#include <memory>

#include "core/precision.hpp"
#include "sum/registry.hpp"
#include "sum/summation_of.hpp"

namespace pairsum {

template <class I>
combination combination_of() {
  std::string smoothing;
  if constexpr (requires { typename I::smoothing; }) smoothing = I::smoothing::name;
  return {std::string(I::name), smoothing, I::dim, std::string(precision_name<typename I::real>())};
}

/// Enrols backend B with interaction I.
template <class B, class I>
void enrol_summation(registry& r) {
  r.enrol(B::traits.name, combination_of<I>(),
          [](const setup& s) -> std::unique_ptr<summation> { return std::make_unique<summation_of<B, I>>(s); });
}

}  // namespace pairsum

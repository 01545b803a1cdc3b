#pragma once
#include "sum/enrol.hpp"
#include "sum/reference_of.hpp"

namespace pairsum {

/// Enrols the reference for interaction I.
template <class I>
void enrol_oracle(registry& r) {
  r.enrol_reference(combination_of<I>(),
                    [](const setup& s) -> std::unique_ptr<reference> { return std::make_unique<reference_of<I>>(s); });
}

}  // namespace pairsum

#pragma once
#include "sum/enrol.hpp"
#include "sum/reference_of.hpp"

namespace pairsum {

/// Enrols the reference for interaction I.
template <class I>
void enrol_oracle(registry& r) {
  r.enrol_reference(words_of<I>(), [](const setup& s) { return std::unique_ptr<reference>(new reference_of<I>(s)); });
}

}  // namespace pairsum

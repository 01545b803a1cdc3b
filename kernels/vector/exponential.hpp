#pragma once
#include <pairsum/vector/highway.hpp>
// After it; its include guard is meant for sources that are compiled for several sets at once.
#include <hwy/contrib/math/math-inl.h>

namespace pairsum {

/// e^x lane by lane, within 1 ulp (Highway's).
template <class D, class V>
HWY_INLINE V exponential_of(D d, V x) {
  return hwy::HWY_NAMESPACE::Exp(d, x);
}

}  // namespace pairsum

#pragma once
#include <pairsum/sum/state.hpp>

namespace pairsum {

/// Calls f with the summation, or the one it wraps, as the state<D, R> it is.
template <class F>
void with_state(summation& s, F&& f) {
  const auto try_one = [&]<int D, class R>() {
    auto* const typed = dynamic_cast<state<D, R>*>(&s.holder());
    if (typed) f(*typed);
    return typed != nullptr;
  };
#define PAIRSUM_TRY(D, R) try_one.template operator()<D, R>() ||
  (void)(PAIRSUM_EACH_D_R(PAIRSUM_TRY) false);
#undef PAIRSUM_TRY
}

}  // namespace pairsum

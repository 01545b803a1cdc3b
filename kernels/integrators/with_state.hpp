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
  (void)(try_one.template operator()<3, double>() || try_one.template operator()<3, float>() ||
         try_one.template operator()<2, double>() || try_one.template operator()<2, float>() ||
         try_one.template operator()<1, double>() || try_one.template operator()<1, float>());
}

}  // namespace pairsum

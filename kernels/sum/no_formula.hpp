#pragma once
#include <pairsum/sum/problem.hpp>

namespace pairsum {

/// Functions that do nothing, for sums whose work is counted: that of the loops is all there is.
template <int D, class R>
const pair_sum<D, R>& no_formula() {
  static const pair_sum<D, R> functions = [] {
    constexpr auto ignore = [](const void*, const row*, std::size_t) {};
    pair_sum<D, R> f{};
    for (rows_function& both : f.both) both = ignore;
    f.own = ignore;
    f.fetch = [](const problem<D, R>&, const std::uint32_t*, unsigned, const rate_view*) {};
    f.zero = [](const rate_view&, std::size_t, std::size_t) {};
    f.add = [](const rate_view&, std::size_t, const rate_view&, std::size_t, std::size_t) {};
    return f;
  }();
  return functions;
}

}  // namespace pairsum

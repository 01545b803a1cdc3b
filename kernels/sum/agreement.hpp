#pragma once
#include <pairsum/sum/rate_table.hpp>

namespace pairsum {

/// Largest |rate - value| over its bound among the entries that the reference evaluated: the rates agree with it if
/// this is at most 1. Infinity for a NaN, for a rate that should be exact and is not, and for tables with other
/// columns.
double share_of_bound(const rate_table& rates, const expectation& expected);

}  // namespace pairsum

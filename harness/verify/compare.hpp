#pragma once
#include <string>

#include <pairsum/sum/rate_table.hpp>

namespace pairsum::harness {

/// How a backend's rates compare with the expectation.
struct verdict {
  bool ok = true;
  double max_rel_err = 0;  ///< |rate - value| / magnitude at the entry nearest to (or farthest over) its bound
  double bound = 0;        ///< bound / magnitude there: ok means max_rel_err <= bound at every entry
  std::string error;       ///< names the worst entry, if not ok
  bool finite = true;      ///< the reference is
};

/// Compares every expected entry: |rate - value| <= bound, integers exactly. A NaN is never within a bound. Both must
/// have the same columns. Where the reference is not finite, nothing is ok.
verdict compare(const rate_table& rates, const expectation& expected);

}  // namespace pairsum::harness

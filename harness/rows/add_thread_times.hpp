#pragma once
#include <algorithm>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// Adds entry by entry; passes and threads that `sum` has not yet are as if they were 0.
inline void add_to(thread_times& sum, const thread_times& more) {
  sum.resize(std::max(sum.size(), more.size()));
  for (std::size_t pass = 0; pass < more.size(); ++pass) {
    sum[pass].resize(std::max(sum[pass].size(), more[pass].size()));
    for (std::size_t k = 0; k < more[pass].size(); ++k) sum[pass][k] += more[pass][k];
  }
}

}  // namespace pairsum::harness

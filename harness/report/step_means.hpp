#pragma once

#include <vector>

#include "harness/report/measured.hpp"

namespace pairsum::harness {

/// Mean of every phase; empty for a phase that one of them did not time.
phases mean_of(const std::vector<phases>& all);

/// Means over all timed steps of a point, of what only some rows have.
class step_means {
 public:
  void add(const sample& s);
  /// Sets the point's busy_s, waiting_s and counters, if any step had them.
  void put(measured_point& p) const;

 private:
  /// A count that some machines do not make.
  struct count_sum {
    std::uint64_t sum = 0, rows = 0;
    void add(const std::optional<std::uint64_t>& more);
    std::optional<std::uint64_t> mean() const;
  };

  thread_times busy_, waiting_;
  std::size_t timed_ = 0;
  count_sum cycles_, instructions_, misses_;
};

}  // namespace pairsum::harness

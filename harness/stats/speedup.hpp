#pragma once

#include <optional>
#include <string>
#include <utility>

#include "harness/stats/ratio.hpp"

namespace pairsum::harness {

/// What a speedup is measured against.
struct speedup_base {
  std::string name;
  double time_s = 0;
};

/// A speedup; there is none without the name and the absolute time of its base.
class speedup {
 public:
  /// @param base what the ratio's base values are, with their median time [s]
  /// @param ratio base time over own time
  /// Throws pairsum::error if the base has no name or no positive time.
  speedup(speedup_base base, const ratio_estimate& ratio) : base_(std::move(base)), ratio_(ratio) {
    if (base_.name.empty() || !(base_.time_s > 0))
      throw error("a speedup needs a base with a name and a positive time");
  }

  const speedup_base& base() const { return base_; }
  const ratio_estimate& ratio() const { return ratio_; }
  double value() const { return ratio_.value; }
  const std::optional<interval>& bounds() const { return ratio_.bounds; }
  std::size_t pairs() const { return ratio_.pairs; }
  /// Speedup per thread: 1 is perfect, if the base ran on one thread.
  double efficiency(int threads) const { return ratio_.value / threads; }

 private:
  speedup_base base_;
  ratio_estimate ratio_;
};

}  // namespace pairsum::harness

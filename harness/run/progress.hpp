#pragma once
#include <string>

#include "harness/measure/stopwatch.hpp"

namespace pairsum::harness {

/// A line on stderr that says how far a run is and when it will be done. Silent unless stderr is a terminal, and in the
/// first two seconds.
class progress {
 public:
  /// `total`: units of work (seconds or points, as long as done() uses the same).
  /// `budget_s`: seconds after which the work ends in any case; 0: none.
  /// `before_s`: seconds that went by before, in another process.
  explicit progress(double total, double budget_s = 0, double before_s = 0)
      : total_(total), budget_s_(budget_s), before_s_(before_s) {}
  ~progress() { clear(); }

  /// `done` units are finished; `what` is under way.
  void show(double done, const std::string& what);
  /// Takes the line away, so that other output starts at the margin.
  void clear();

 private:
  double total_, budget_s_, before_s_;
  bool shown_ = false;
  stopwatch since_start_;
};

/// True if stderr is a terminal.
bool stderr_is_terminal();

}  // namespace pairsum::harness

#pragma once
#include <string>

#include "harness/measure/stopwatch.hpp"

namespace pairsum::harness {

/// Where a run stands when one of its processes begins; `done_s`, `this_s` and `all_s` are estimated seconds of work.
struct standing {
  double elapsed_s = 0, done_s = 0, this_s = 0, all_s = 1;
  double shown = 0;  ///< the share of the run that is said to be done
  std::string text;  ///< like "parallel_rest round 3/12, +-2.3 % (goal 2.0)"
};

/// One line on stderr that says how far a run is and when it will be done. It is cut to the terminal's width, never
/// goes back though estimates change, and is written at most 10 times a second, even if several processes write it one
/// after another. Silent unless stderr is a terminal, and in the first two seconds.
class progress {
 public:
  /// `total`: units of work (estimated seconds or points, as long as show() uses the same).
  /// `budget_s`: seconds after which the work ends in any case; 0: none.
  explicit progress(double total, double budget_s = 0) : progress(standing{.all_s = total, .text = {}}, budget_s) {}
  /// Goes on with the line of another process.
  explicit progress(const standing& from, double budget_s = 0);
  ~progress() { clear(); }
  progress(const progress&) = delete;
  progress& operator=(const progress&) = delete;

  /// `done` units are finished; `what` is under way.
  void show(double done, const std::string& what);
  /// Takes the line away, so that other output starts at the margin.
  void clear();

  /// The share of the run to be shown with `done` units finished: what was left to show when this process began is
  /// shared out among the work that was left then.
  double share(double done) const;

  /// The line stays, for another process.
  void hand_over() { shown_ = false; }
  /// Another process begins that may write the line; it has ended.
  void begin(const standing& from);
  void take_over();

 private:
  std::string line(double done, const std::string& what, int columns) const;

  standing from_;
  double budget_s_;
  bool shown_;                             ///< by this process or, as far as it knows, by another
  stopwatch since_begin_, since_written_;  ///< another process may have written when this one began
};

}  // namespace pairsum::harness

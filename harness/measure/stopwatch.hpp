#pragma once
#include <chrono>

namespace pairsum::harness {

/// Seconds on the steady clock since construction or the last lap.
class stopwatch {
 public:
  /// Seconds since the last lap (or construction), and starts the next.
  double lap() {
    const auto now = clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }
  double seconds() const { return std::chrono::duration<double>(clock::now() - start_).count(); }

 private:
  using clock = std::chrono::steady_clock;
  clock::time_point start_ = clock::now();
};

}  // namespace pairsum::harness

#include "harness/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pairsum::harness {

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

void progress::show(double done, const std::string& what) {
  const double elapsed = before_s_ + since_start_.seconds();
  if (!stderr_is_terminal() || elapsed < 2) return;
  const double share = std::clamp(done / total_, 0.0, 1.0);
  constexpr int width = 24;
  const int filled = static_cast<int>(share * width);
  std::string eta = "--:--";
  if (share > 0.01) {
    double seconds = elapsed / share - elapsed;
    if (budget_s_ > 0) seconds = std::clamp(budget_s_ - elapsed, 0.0, seconds);
    const auto left = std::lround(seconds);
    eta = fmt::format("{}:{:02}", left / 60, left % 60);
  }
  fmt::print(stderr, "\r\x1b[K[{}{}] {:3.0f} %  ETA {}  {}", std::string(filled, '#'), std::string(width - filled, '.'),
             100 * share, eta, what);
  std::fflush(stderr);
  shown_ = true;
}

void progress::clear() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
  shown_ = false;
}

}  // namespace pairsum::harness

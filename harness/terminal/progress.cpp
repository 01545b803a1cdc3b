#include "harness/terminal/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "harness/terminal/terminal.hpp"

namespace pairsum::harness {
namespace {

constexpr double silent_s = 2;   ///< at the beginning
constexpr double pause_s = 0.1;  ///< between two updates

}  // namespace

progress::progress(const standing& from, double budget_s)
    : from_(from), budget_s_(budget_s), shown_(from.elapsed_s >= silent_s && is_terminal(stderr)) {}

double progress::share(double done) const {
  const double left = from_.all_s - from_.done_s;
  const double part = left > 0 ? std::clamp((done - from_.done_s) / left, 0.0, 1.0) : 1;
  return from_.shown + (1 - from_.shown) * part;
}

std::string progress::line(double done, const std::string& what, int columns) const {
  const double shown = share(done), elapsed = from_.elapsed_s + since_begin_.seconds();
  const int width = std::clamp(columns / 5, 4, 24);
  const int filled = static_cast<int>(shown * width);
  const int percent = std::min(99, static_cast<int>(100 * shown));  // at 100 % the line is gone
  std::string eta = "--:--";
  if (done > 0.01 * from_.all_s) {
    double seconds = elapsed * std::max(0.0, from_.all_s / done - 1);
    if (budget_s_ > 0) seconds = std::clamp(budget_s_ - elapsed, 0.0, seconds);
    const auto left = std::lround(seconds);
    eta = fmt::format("{}:{:02}", left / 60, left % 60);
  }
  const std::string whole = fmt::format("[{}{}] {:3} %  ETA {}  {}", std::string(filled, '#'),
                                        std::string(width - filled, '.'), percent, eta, what);
  return std::string(cut_to(whole, static_cast<std::size_t>(std::max(0, columns - 1))));
}

void progress::show(double done, const std::string& what) {
  if (!is_terminal(stderr) || from_.elapsed_s + since_begin_.seconds() < silent_s) return;
  if (since_written_.seconds() < pause_s) return;
  fmt::print(stderr, "\r\x1b[K{}", line(done, what, columns_of(stderr)));
  std::fflush(stderr);
  shown_ = true;
  since_written_.lap();
}

void progress::clear() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
  shown_ = false;
}

void progress::begin(const standing& from) {
  from_ = from;
  since_begin_.lap();
}

void progress::take_over() {
  if (!is_terminal(stderr) || since_begin_.seconds() < pause_s) return;  // it was too short to write
  shown_ = true;
  since_written_.lap();
}

}  // namespace pairsum::harness

#pragma once
#include <algorithm>
#include <chrono>
#include <vector>

#include <pairsum/core/pass_observer.hpp>

namespace pairsum::harness {

/// Times the passes of one summation: how long each thread worked in each, and how long it waited for the others, which
/// is the pass's length less its work. A pass begins when its predecessor ends, so waking the threads counts as
/// waiting.
class pass_times final : public pass_observer {
 public:
  using table = std::vector<std::vector<double>>;  ///< seconds by [pass][thread]

  explicit pass_times(int threads) : lanes_(static_cast<std::size_t>(threads)) {}

  void pass_begins(unsigned pass) override {
    // A new sum discards the one before.
    if (pass == 0)
      for (lane& l : lanes_) l.busy.clear();
    if (pass == 0) lengths_.clear();
    begin_ = clock::now();
  }
  void work_begins(unsigned pass, int thread) override {
    lane& l = lanes_[index(thread)];
    if (l.busy.size() <= pass) l.busy.resize(pass + 1, 0.0);
    l.begin = clock::now();
  }
  void work_ends(unsigned pass, int thread) override {
    lane& l = lanes_[index(thread)];
    l.busy[pass] += seconds(clock::now() - l.begin);
  }
  void pass_ends(unsigned) override {
    const auto now = clock::now();
    lengths_.push_back(seconds(now - begin_));
    begin_ = now;
  }

  /// Did the backend mark any pass?
  bool any() const { return !lengths_.empty(); }
  table busy() const {
    return each([](double busy, double) { return busy; });
  }
  table waiting() const {
    return each([](double busy, double length) { return std::max(0.0, length - busy); });
  }

 private:
  using clock = std::chrono::steady_clock;
  static double seconds(clock::duration d) { return std::chrono::duration<double>(d).count(); }
  std::size_t index(int thread) const {
    return std::min(lanes_.size() - 1, static_cast<std::size_t>(std::max(0, thread)));
  }

  template <class F>
  table each(F&& f) const {
    table all;
    for (std::size_t pass = 0; pass < lengths_.size(); ++pass) {
      all.emplace_back();
      for (const lane& l : lanes_) all.back().push_back(f(pass < l.busy.size() ? l.busy[pass] : 0.0, lengths_[pass]));
    }
    return all;
  }

  /// A thread writes only to its own entry, in separate cache lines.
  struct alignas(128) lane {
    clock::time_point begin;
    std::vector<double> busy;
  };
  std::vector<lane> lanes_;
  std::vector<double> lengths_;
  clock::time_point begin_ = clock::now();
};

}  // namespace pairsum::harness

#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pairsum::harness {

/// One thing the kernel can count, in the terms of perf_event_open(2).
struct counter_event {
  std::string name;
  std::uint32_t type;
  std::uint64_t config;
};

/// The processor's counters of this process, user space alone, where the kernel lets it read them. Make it before the
/// threads it is to count: those started later by its thread, or by threads that thread has started, are counted too.
/// Nothing throws; what cannot be counted is empty.
class counters {
 public:
  /// What was counted in a phase; empty where it cannot be.
  struct counts {
    std::optional<std::uint64_t> cycles, instructions, cache_misses;
  };

  /// Cycles, instructions, misses of the last-level cache.
  counters();
  /// Up to three events of the caller's choice, in the place of those.
  explicit counters(const std::vector<counter_event>& events);
  ~counters();
  counters(const counters&) = delete;

  void start();
  /// What was counted since start().
  counts stop();

  /// Why nothing is counted: "none: perf_event_open: No such file or directory"; "" if something is.
  const std::string& why() const { return why_; }
  /// The names of what is counted, or why(): "cycles, instructions, cache_misses".
  std::string description() const;

 private:
  struct reading {
    std::uint64_t value = 0, enabled_ns = 0, running_ns = 0;
  };
  struct counter {
    std::string name;
    int file = -1;  ///< -1: not counted
    reading begin;
  };
  static std::optional<reading> read_now(int file);
  std::vector<counter> counters_;
  std::string why_;
};

}  // namespace pairsum::harness

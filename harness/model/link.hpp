#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace pairsum::harness {

/// A message of b bytes from one rank to another takes latency_s + b / bandwidth_bytes_per_s.
struct link_rates {
  double latency_s = 0;
  double bandwidth_bytes_per_s = 0;
};

/// How long messages of one size took, there and back.
struct bounce_times {
  std::size_t bytes = 0;
  std::vector<double> seconds;  ///< each repetition's
};

/// Both rates from half of the median time of small messages and of large ones. Throws pairsum::error unless there are
/// times, all positive and finite, the large messages are larger, and they took longer by more than noise could invent:
/// their time per byte must leave the small messages a latency above 0.
link_rates fit_link(const bounce_times& small, const bounce_times& large);

/// Sends a message from rank 0 to rank 1 and back, as ranks::job::bounce does; on other ranks it does nothing.
using bouncer = std::function<void(std::span<std::byte> message)>;

struct link_limits {
  std::size_t small_bytes = 8, large_bytes = std::size_t{4} << 20;
  int small_repetitions = 1000, large_repetitions = 30;
  int warm_up = 5;  ///< more of each size, before, whose times are not kept
};

/// Times the same number of messages on every rank, so that all ranks may call it together.
bounce_times time_bounces(const bouncer& bounce, std::size_t bytes, int repetitions, int warm_up);

/// The ping-pong. All ranks call it; the result means something on rank 0 alone, and is zeros where `timed` is false.
/// Throws like fit_link where it is true.
link_rates measure_link(const bouncer& bounce, bool timed, const link_limits& limits = {});

}  // namespace pairsum::harness

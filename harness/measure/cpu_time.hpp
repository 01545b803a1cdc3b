#pragma once
#include <sys/resource.h>

#include <optional>

namespace pairsum::harness {

/// Processor time since the machine started [s].
struct machine_time {
  double busy_s = 0;   ///< of all processes and the kernel, and of the hypervisor (steal)
  double total_s = 0;  ///< busy and idle, over all processors
};

/// Empty where /proc does not report it. The kernel counts in ticks, mostly of 10 ms.
std::optional<machine_time> machine_time_now();

/// A share of others from which on a measurement counts as disturbed.
inline constexpr double disturbing_share = 0.05;

/// The share of the machine's time between two readings that others used, besides `own_s` seconds of our own; empty if
/// a reading is, or if they are the same.
std::optional<double> share_of_others(const std::optional<machine_time>& before,
                                      const std::optional<machine_time>& after, double own_s);

/// Processor time that the kernel counted, in the program and in itself [s].
double cpu_time_of(const rusage& use);

/// Processor time this process has used, its threads included [s].
double own_time();

}  // namespace pairsum::harness

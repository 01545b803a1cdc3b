#pragma once
#include <sys/resource.h>

#include <optional>

namespace pairsum::harness {

/// Processor time since the machine started [s].
struct machine_time {
  double busy_s = 0;   ///< of all processes and the kernel, and what a hypervisor took away (steal)
  double total_s = 0;  ///< busy and idle, over all processors
};

/// Empty where /proc does not tell. The kernel counts in ticks, mostly of 10 ms.
std::optional<machine_time> machine_time_now();

/// Which share of the machine's time between two readings went to others than those who used `own_s` seconds of it;
/// empty if a reading is, or if they are the same.
std::optional<double> share_of_others(const std::optional<machine_time>& before,
                                      const std::optional<machine_time>& after, double own_s);

/// Processor time that the kernel counted, in the program and in itself [s].
double cpu_time_of(const rusage& use);

/// Processor time this process has used, its threads included [s].
double own_time();

}  // namespace pairsum::harness

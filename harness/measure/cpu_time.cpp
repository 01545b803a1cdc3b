#include "harness/measure/cpu_time.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace pairsum::harness {

std::optional<machine_time> machine_time_now() {
  std::ifstream stat("/proc/stat");
  std::string word;
  // user nice system idle iowait irq softirq steal
  double ticks[8] = {};
  if (!(stat >> word) || word != "cpu") return std::nullopt;
  for (double& t : ticks)
    if (!(stat >> t)) return std::nullopt;
  const double per_s = static_cast<double>(sysconf(_SC_CLK_TCK));
  const double idle = ticks[3] + ticks[4];
  double all = 0;
  for (const double t : ticks) all += t;
  return machine_time{(all - idle) / per_s, all / per_s};
}

std::optional<double> share_of_others(const std::optional<machine_time>& before,
                                      const std::optional<machine_time>& after, double own_s) {
  if (!before || !after || !(after->total_s > before->total_s)) return std::nullopt;
  const double others = after->busy_s - before->busy_s - own_s;
  return std::clamp(others / (after->total_s - before->total_s), 0.0, 1.0);
}

double cpu_time_of(const rusage& use) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

double own_time() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return cpu_time_of(use);
}

}  // namespace pairsum::harness

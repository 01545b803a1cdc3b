#include "harness/measure/counters.hpp"

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

namespace pairsum::harness {
namespace {

int open_counter(const counter_event& e) {
  perf_event_attr a{};
  a.size = sizeof a;
  a.type = e.type;
  a.config = e.config;
  a.disabled = 1;
  a.inherit = 1;
  a.exclude_kernel = 1;
  a.exclude_hv = 1;
  // More events than the processor has counters take turns: then the times say how much of the phase was counted.
  a.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
  return static_cast<int>(syscall(SYS_perf_event_open, &a, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

}  // namespace

counters::counters()
    : counters({{"cycles", PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES},
                {"instructions", PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS},
                {"cache_misses", PERF_TYPE_HARDWARE, PERF_COUNT_HW_CACHE_MISSES}}) {}

counters::counters(const std::vector<counter_event>& events) {
  bool any = false;
  std::string refused = "no events";
  for (const counter_event& e : events) {
    const int file = open_counter(e);
    if (file < 0) refused = std::string("perf_event_open: ") + std::strerror(errno);
    any = any || file >= 0;
    counters_.push_back({e.name, file, {}});
  }
  if (!any) why_ = "none: " + refused;
}

counters::~counters() {
  for (const counter& c : counters_)
    if (c.file >= 0) close(c.file);
}

std::optional<counters::reading> counters::read_now(int file) {
  reading r;
  if (file < 0 || read(file, &r, sizeof r) != sizeof r) return std::nullopt;
  return r;
}

void counters::start() {
  for (counter& c : counters_)
    if (c.file >= 0) {
      c.begin = read_now(c.file).value_or(reading{});
      ioctl(c.file, PERF_EVENT_IOC_ENABLE, 0);
    }
}

counters::counts counters::stop() {
  for (const counter& c : counters_)
    if (c.file >= 0) ioctl(c.file, PERF_EVENT_IOC_DISABLE, 0);
  counts all;
  std::optional<std::uint64_t>* const places[] = {&all.cycles, &all.instructions, &all.cache_misses};
  for (std::size_t k = 0; k < counters_.size() && k < std::size(places); ++k) {
    const auto now = read_now(counters_[k].file);
    if (!now) continue;
    const reading& begin = counters_[k].begin;
    const std::uint64_t enabled = now->enabled_ns - begin.enabled_ns, running = now->running_ns - begin.running_ns;
    if (running == 0) continue;  // it had no turn
    const double seen = static_cast<double>(running) / static_cast<double>(enabled);
    *places[k] = static_cast<std::uint64_t>(std::llround(static_cast<double>(now->value - begin.value) / seen));
  }
  return all;
}

std::string counters::description() const {
  if (!why_.empty()) return why_;
  std::string text;
  for (const counter& c : counters_)
    if (c.file >= 0) text += (text.empty() ? "" : ", ") + c.name;
  return text;
}

}  // namespace pairsum::harness

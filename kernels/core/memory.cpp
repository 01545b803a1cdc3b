#include <pairsum/core/memory.hpp>

#include <unistd.h>

#include <algorithm>

#include <pairsum/core/error.hpp>
#include <pairsum/core/job_limits.hpp>

namespace pairsum {
namespace {

double memory_of_machine() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

double usable_memory() {
  const double machine = memory_of_machine();
  const auto& limit = limits_of_this_job().memory;
  return limit ? std::min(machine, static_cast<double>(*limit)) : machine;
}

void check_memory(double bytes, const std::string& what, const std::string& advice) {
  const double memory = usable_memory();
  if (bytes <= memory) return;
  const auto gib = [](double b) { return std::to_string(static_cast<unsigned long long>(b / (1 << 30))) + " GiB"; };
  throw error(what + " would take about " + gib(bytes) + " of memory, this machine has " + gib(memory) +
              (memory < memory_of_machine() ? " for this job" : "") + "; " + advice);
}

}  // namespace pairsum

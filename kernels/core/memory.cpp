#include <pairsum/core/memory.hpp>

#include <unistd.h>

#include <pairsum/core/error.hpp>

namespace pairsum {

void check_memory(double bytes, const std::string& what, const std::string& advice) {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes <= memory) return;
  const auto gib = [](double b) { return std::to_string(static_cast<unsigned long long>(b / (1 << 30))) + " GiB"; };
  throw error(what + " would take about " + gib(bytes) + " of memory, this machine has " + gib(memory) + "; " + advice);
}

}  // namespace pairsum

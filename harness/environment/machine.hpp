#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace pairsum::harness {

/// What is known of the machine; sizes in bytes per cache level ("L1d", "L2", "L3").
struct machine {
  std::string host, cpu, os_kernel;
  std::map<std::string, std::uint64_t> caches;
  int cores = 1;  ///< cores this process may use
  std::optional<std::string> governor;
};

machine describe_machine();

/// NUMA nodes this process may use; 1 if unknown.
int numa_nodes();

/// Threads the machine has for this process (hardware threads it may run on), as it was when first asked.
int usable_cores();

}  // namespace pairsum::harness

#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pairsum {
struct job_limits;
}

namespace pairsum::harness {

/// What is known of the machine; sizes in bytes per cache level ("L1d", "L2", "L3").
struct machine {
  std::string host, cpu, os_kernel;
  std::map<std::string, std::uint64_t> caches;
  int cores = 1;  ///< cores this process may use
  std::optional<std::string> governor;
  std::string limits;  ///< of control groups, see limits_text()
};

machine describe_machine();

/// NUMA nodes this process may use; 1 if unknown.
int numa_nodes();

/// Hardware threads on which this process may run, as it was started: neither OMP_PROC_BIND nor a binding of its own
/// change that, and taskset does. Each program that holds this file also frees its first thread at its start, which
/// OMP_PROC_BIND would keep on one of them.
int units_given();

/// How many threads keep running at the same time on so many hardware threads: at most as many whole processors as
/// control groups give (more would be paused in turns), and at least 1.
int cores_within(int units, const job_limits& limits);

/// Threads the machine has for this process: those that it was given, within its control groups' limits.
int usable_cores();

/// Nodes of the job of a batch system that runs this process, as it tells; 1 without one.
int job_nodes();

/// "2.5 processors, 4 GiB of memory", or "none".
std::string limits_text(const job_limits& limits);

/// One line where control groups give less time than so many hardware threads have; else "". Without arguments, of this
/// process.
std::string limits_note(int units, const job_limits& limits);
std::string limits_note();

/// One line where one of these numbers of threads, those of all ranks together, is larger than what the job has: its
/// nodes times usable_cores(); else "".
std::string too_many(const std::vector<int>& threads);

/// Throws pairsum::error for more threads than the job has cores, unless that is wanted.
void check_cores(const std::vector<int>& threads, bool oversubscribe);

}  // namespace pairsum::harness

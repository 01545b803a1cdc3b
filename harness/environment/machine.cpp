#include "harness/environment/machine.hpp"

#include <hwloc.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include <pairsum/core/error.hpp>
#include <pairsum/core/job_limits.hpp>
#include "harness/rows/fields.hpp"

namespace pairsum::harness {
namespace {

std::map<std::string, std::uint64_t> cache_sizes() {
  std::map<std::string, std::uint64_t> sizes;
  hwloc_topology_t topology;
  if (hwloc_topology_init(&topology) != 0) return sizes;
  if (hwloc_topology_load(topology) == 0) {
    const struct {
      const char* name;
      hwloc_obj_type_t type;
    } levels[] = {{"L1d", HWLOC_OBJ_L1CACHE}, {"L2", HWLOC_OBJ_L2CACHE}, {"L3", HWLOC_OBJ_L3CACHE}};
    for (const auto& level : levels)
      if (hwloc_obj_t o = hwloc_get_obj_by_type(topology, level.type, 0)) sizes[level.name] = o->attr->cache.size;
  }
  hwloc_topology_destroy(topology);
  return sizes;
}

/// What others may print.
std::string text_or_unknown(const std::string& text) { return has_controls(text) ? "unknown" : text; }

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name") && line.find(": ") != line.npos) return line.substr(line.find(": ") + 2);
  return "unknown";
}

// What this process may run on, as it was started. A constructor of libgomp pins the first thread to one core where
// OMP_PROC_BIND or GOMP_CPU_AFFINITY is set; what stands in .preinit_array runs before it, at_start after it.
cpu_set_t started_on;
bool is_known = false;

void look_at_start(int, char**, char**) { is_known = sched_getaffinity(0, sizeof started_on, &started_on) == 0; }
[[gnu::section(".preinit_array"), gnu::used]] void (*before_constructors)(int, char**, char**) = look_at_start;

const struct unpinned {
  unpinned() {
    if (is_known) sched_setaffinity(0, sizeof started_on, &started_on);
  }
} at_start;

}  // namespace

int units_given() {
  if (is_known) return std::max(1, CPU_COUNT(&started_on));
  return std::max(1, static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)));
}

int cores_within(int units, const job_limits& limits) {
  return limits.cpus ? std::clamp(static_cast<int>(std::min(*limits.cpus + 1e-6, 1e6)), 1, units) : units;
}

int usable_cores() { return cores_within(units_given(), limits_of_this_job()); }

int job_nodes() {
  for (const char* const name : {"SLURM_JOB_NUM_NODES", "SLURM_NNODES"})
    if (const char* const text = std::getenv(name))
      if (const int nodes = std::atoi(text); nodes >= 1) return nodes;
  std::set<std::string> hosts;  // PBS and LSF list them, one a line
  for (const char* const name : {"PBS_NODEFILE", "LSB_DJOB_HOSTFILE"})
    if (const char* const file = std::getenv(name); file != nullptr && hosts.empty()) {
      std::ifstream list(file);
      for (std::string host; list >> host;) hosts.insert(host);
    }
  return std::max(1, static_cast<int>(hosts.size()));
}

std::string limits_text(const job_limits& limits) {
  std::string text = limits.cpus ? fmt::format("{:.4g} processors", *limits.cpus) : "";
  if (limits.memory)
    text += fmt::format("{}{:.3g} GiB of memory", text.empty() ? "" : ", ",
                        static_cast<double>(*limits.memory) / (std::uint64_t{1} << 30));
  return text.empty() ? "none" : text;
}

std::string limits_note(int units, const job_limits& limits) {
  if (!limits.cpus || *limits.cpus >= units) return "";
  return fmt::format("a control group gives this job {:.4g} of {} hardware threads: {} count{} as all of them{}",
                     *limits.cpus, units, cores_within(units, limits), cores_within(units, limits) == 1 ? "s" : "",
                     *limits.cpus < 1 ? ", and even that one is paused now and then" : "");
}

std::string limits_note() { return limits_note(units_given(), limits_of_this_job()); }

std::string too_many(const std::vector<int>& threads) {
  const int cores = usable_cores() * job_nodes(), most = threads.empty() ? 1 : *std::ranges::max_element(threads);
  if (most <= cores) return "";
  const std::string why = limits_note();
  return fmt::format("{} threads on {} core{} tell little of the machine; --oversubscribe measures them even so{}",
                     most, cores, cores == 1 ? "" : "s", why.empty() ? "" : " (" + why + ")");
}

void check_cores(const std::vector<int>& threads, bool oversubscribe) {
  if (const std::string why = too_many(threads); !why.empty() && !oversubscribe) throw error(why);
}

int numa_nodes() {
  hwloc_topology_t topology;
  if (hwloc_topology_init(&topology) != 0) return 1;
  int nodes = 1;
  if (hwloc_topology_load(topology) == 0)
    nodes = std::max(1, hwloc_bitmap_weight(hwloc_topology_get_allowed_nodeset(topology)));
  hwloc_topology_destroy(topology);
  return nodes;
}

machine describe_machine() {
  machine m;
  char host[256] = "unknown";
  gethostname(host, sizeof host - 1);
  m.host = text_or_unknown(host);
  m.cpu = text_or_unknown(cpu_name());
  utsname os{};
  if (uname(&os) == 0) m.os_kernel = std::string(os.sysname) + " " + os.release;
  m.caches = cache_sizes();
  m.cores = usable_cores();
  m.limits = limits_text(limits_of_this_job());
  std::ifstream governor("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  if (std::string word; governor >> word) m.governor = word;
  return m;
}

}  // namespace pairsum::harness

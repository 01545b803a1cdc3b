#include "harness/environment/machine.hpp"

#include <hwloc.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

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

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name") && line.find(": ") != line.npos) return line.substr(line.find(": ") + 2);
  return "unknown";
}

}  // namespace

int usable_cores() {
  static const int cores = [] {  // once, before threads are bound
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
    return std::max(1, static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)));
  }();
  return cores;
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
  m.host = host;
  m.cpu = cpu_name();
  utsname os{};
  if (uname(&os) == 0) m.os_kernel = std::string(os.sysname) + " " + os.release;
  m.caches = cache_sizes();
  m.cores = usable_cores();
  std::ifstream governor("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  if (std::string word; governor >> word) m.governor = word;
  return m;
}

}  // namespace pairsum::harness

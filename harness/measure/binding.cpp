#include "harness/measure/binding.hpp"

#include <hwloc.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>

#include <pairsum/core/names.hpp>

namespace pairsum::harness {

std::vector<int> cores_first(const std::vector<unit_place>& places) {
  struct ranked {
    std::array<std::size_t, 4> rank;  // within its core, of the core in its node, of the node in its package, package
    int unit;
  };
  std::map<int, std::vector<int>> nodes_of, cores_of, units_of;  // of a package, node, core; in order of appearance
  const auto rank_in = [](std::vector<int>& seen, int id) {
    const auto at = std::ranges::find(seen, id) - seen.begin();
    if (static_cast<std::size_t>(at) == seen.size()) seen.push_back(id);
    return static_cast<std::size_t>(at);
  };
  std::vector<int> packages;
  std::vector<ranked> all;
  for (const unit_place& p : places)
    all.push_back({{rank_in(units_of[p.core], p.unit), rank_in(cores_of[p.node], p.core),
                    rank_in(nodes_of[p.package], p.node), rank_in(packages, p.package)},
                   p.unit});
  std::ranges::stable_sort(all, {}, &ranked::rank);
  std::vector<int> units;
  for (const ranked& r : all) units.push_back(r.unit);
  return units;
}

namespace {

struct bitmap {
  hwloc_bitmap_t set = hwloc_bitmap_alloc();
  bitmap() = default;
  bitmap(const bitmap&) = delete;
  ~bitmap() { hwloc_bitmap_free(set); }
};

/// The number of the nearest object of that type above the unit; `otherwise` on machines that tell of none.
int above(hwloc_topology_t topology, hwloc_obj_type_t type, hwloc_obj_t unit, int otherwise) {
  const hwloc_obj_t o = hwloc_get_ancestor_obj_by_type(topology, type, unit);
  return o ? static_cast<int>(o->logical_index) : otherwise;
}

std::vector<unit_place> places_in(hwloc_topology_t topology, hwloc_const_bitmap_t allowed) {
  std::vector<unit_place> places;
  for (hwloc_obj_t u = nullptr; (u = hwloc_get_next_obj_by_type(topology, HWLOC_OBJ_PU, u));) {
    const int unit = static_cast<int>(u->os_index);
    if (!hwloc_bitmap_isset(allowed, u->os_index)) continue;
    const int node = u->nodeset ? std::max(0, hwloc_bitmap_first(u->nodeset)) : 0;
    places.push_back({unit, above(topology, HWLOC_OBJ_CORE, u, unit), node, above(topology, HWLOC_OBJ_PACKAGE, u, 0)});
  }
  return places;
}

}  // namespace

struct thread_binding::state {
  std::string word;
  hwloc_topology_t topology = nullptr;
  bitmap process;  ///< what the process may use
  std::vector<int> units;
  std::string why;                      ///< nothing was bound from the start
  mutable std::atomic<int> failed = 0;  ///< errno of a thread that could not be bound

  bool bind(hwloc_const_bitmap_t set) const {
    if (hwloc_set_cpubind(topology, set, HWLOC_CPUBIND_THREAD) == 0) return true;
    failed = errno == 0 ? EINVAL : errno;
    return false;
  }
  /// What stands in the way of binding, "" if nothing does; leaves the calling thread as it was.
  std::string find_units() {
    if (hwloc_topology_init(&topology) != 0) return "the machine's topology is unknown";
    if (hwloc_topology_load(topology) != 0) return "the machine's topology cannot be read";
    if (hwloc_get_cpubind(topology, process.set, HWLOC_CPUBIND_THREAD) != 0) return std::strerror(errno);
    units = cores_first(places_in(topology, process.set));
    if (units.empty()) return "no processing unit of this process is known";
    bitmap one;
    hwloc_bitmap_only(one.set, static_cast<unsigned>(units.front()));
    if (!bind(one.set) || !bind(process.set)) return std::strerror(failed);
    return {};
  }
  ~state() {
    if (topology) hwloc_topology_destroy(topology);
  }
};

thread_binding::thread_binding(std::string_view word) : state_(std::make_unique<state>()) {
  check_word("binding", word, std::vector<std::string_view>{"cores_first", "none"});
  state_->word = word;
  if (word == "none") return;
  state_->why = state_->find_units();
  if (!state_->why.empty()) state_->units.clear();
}

thread_binding::~thread_binding() = default;

bool thread_binding::bind_this_thread(int k) const {
  if (state_->units.empty() || k < 0) return false;
  bitmap one;
  hwloc_bitmap_only(one.set, static_cast<unsigned>(state_->units[static_cast<std::size_t>(k) % state_->units.size()]));
  return state_->bind(one.set);
}

void thread_binding::release_this_thread() const {
  if (!state_->units.empty()) state_->bind(state_->process.set);
}

const std::vector<int>& thread_binding::units() const { return state_->units; }

std::string thread_binding::description() const {
  if (state_->word == "none") {
    if (omp_get_proc_bind() == omp_proc_bind_false) return "none";
    const char* who = "OMP_PROC_BIND";
    for (const char* name : {"GOMP_CPU_AFFINITY", "OMP_PLACES", "OMP_PROC_BIND"})  // the last that is set decides
      if (std::getenv(name) != nullptr) who = name;
    return std::string("none: left to ") + who;
  }
  if (!state_->why.empty()) return "none: " + state_->why;
  if (const int e = state_->failed) return std::string("none: ") + std::strerror(e);
  std::string text = state_->word;
  char before = ' ';
  for (const int u : state_->units) {
    text += before + std::to_string(u);
    before = ',';
  }
  return text;
}

}  // namespace pairsum::harness

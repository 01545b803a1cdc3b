#pragma once
#include <unistd.h>

#include <fstream>

#include <pairsum/integrators/with_state.hpp>
#include "cloud.hpp"

// Worlds for grids: crowded, or so large that almost all of them is empty.
namespace pairsum::test_kit {

struct world_kind {
  int dim;
  std::string precision;
};
inline std::ostream& operator<<(std::ostream& o, const world_kind& k) { return o << k.dim << "D_" << k.precision; }

/// Every dimension and precision of positions of this build.
inline std::vector<world_kind> world_kinds() {
  std::vector<world_kind> all;
  for (const int dim : registry::instance().dims())
    for (const std::string& precision : registry::instance().precisions())
      if (precision != "mixed") all.push_back({dim, precision});
  return all;
}

/// `n` fluid particles, and a third as many boundary, uniform in a box of that many H per edge.
inline scene crowded_world(const world_kind& k, double edges, std::uint32_t n) {
  cloud c;
  c.dim = k.dim;
  c.fluid = n;
  c.boundary = n / 3;
  c.length = edges;
  c.corner = -0.25;
  scene s = make_cloud(c);
  s.world.precision = k.precision;
  return s;
}

/// `n` fluid particles in groups of four within reach of each other, spread over `edges` H per axis, some on the faces.
inline scene sparse_world(const world_kind& k, double edges, std::uint32_t n) {
  scene s = crowded_world(k, edges, n);
  const counter_random random(11);
  const double low = s.world.omega_low[0], H = s.world.constants.H;
  for (std::uint32_t i = 0; i < n; ++i) {
    s.particles.kind[i] = particle_kind::fluid;
    for (unsigned d = 0; d < s.particles.x.size(); ++d) {
      const double u = i < 4 ? 0 : i < 8 ? 1 : random.uniform(4 * (i / 4) + d);
      const double x = low + u * edges * H + H * random.uniform(100000 + 4 * i + d, -0.25, 0.25);
      s.particles.x[d][i] = std::clamp(x, low, s.world.omega_high[d]);
    }
  }
  s.particles.resize(n);
  return s;
}

/// Ids in the order of memory.
inline std::vector<std::uint32_t> ids_in_order(summation& sum) {
  std::vector<std::uint32_t> ids;
  with_state(sum,
             [&]<int D, class R>(state<D, R>& st) { ids.assign(st.particles().id.begin(), st.particles().id.end()); });
  return ids;
}

/// Memory that this process holds now.
inline std::size_t resident_bytes() {
  std::size_t total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace pairsum::test_kit

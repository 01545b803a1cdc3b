#include "harness/evolve/balance.hpp"

#include <algorithm>
#include <cmath>

namespace pairsum::harness {

double internal_energy(const tait& eos, double rho) {
  const double s = rho / eos.rho0;
  return eos.B / eos.rho0 * ((std::pow(s, tait::gamma - 1) - 1) / (tait::gamma - 1) + 1 / s - 1);
}

balance balance_of(const particle_table& p, double gravity, const tait& eos) {
  balance b;
  const auto up = static_cast<std::size_t>(p.dim == 1 ? 0 : 1);
  bool first = true;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] != particle_kind::fluid) continue;
    double v2 = 0;
    for (std::size_t d = 0; d < p.x.size(); ++d) {
      v2 += p.v[d][i] * p.v[d][i];
      b.momentum[d] += p.m[i] * p.v[d][i];
      b.low[d] = first ? p.x[d][i] : std::min(b.low[d], p.x[d][i]);
      b.high[d] = first ? p.x[d][i] : std::max(b.high[d], p.x[d][i]);
    }
    b.kinetic += p.m[i] * v2 / 2;
    b.potential += p.m[i] * gravity * p.x[up][i];
    b.internal += p.m[i] * internal_energy(eos, p.rho[i]);
    b.speed = std::max(b.speed, std::sqrt(v2));
    b.rho_low = first ? p.rho[i] : std::min(b.rho_low, p.rho[i]);
    b.rho_high = first ? p.rho[i] : std::max(b.rho_high, p.rho[i]);
    first = false;
  }
  return b;
}

}  // namespace pairsum::harness

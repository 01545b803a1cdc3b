#include "harness/evolve/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <pairsum/integrators/with_state.hpp>

namespace pairsum::harness {

extremes extremes_of(summation& s, double gravity, const team& t) {
  std::vector<extremes> pieces(static_cast<std::size_t>(t.threads()));
  with_state(s, [&]<int D, class R>(state<D, R>& st) {
    const auto rates = st.rates_of_state();
    const auto& p = st.particles();
    constexpr int up = D == 1 ? 0 : 1;
    t.for_pieces(st.fluid_count(), [&](std::size_t begin, std::size_t end, std::size_t piece) {
      extremes own;
      double v2_most = 0, a2_most = 0;
      for (std::size_t i = begin; i < end; ++i) {
        if (p.kind[i] == particle_kind::ghost) continue;  // another rank's
        double v2 = 0, a2 = 0, x = 0;
        for (int d = 0; d < D; ++d) {
          const auto v = static_cast<double>(p.v[d][i]);
          v2 += v * v;
          x += static_cast<double>(p.x[d][i]);
          if (!rates) continue;
          const double a = static_cast<double>(rates.dv[d][i]) - (d == up ? gravity : 0);
          a2 += a * a;
        }
        const auto rho = static_cast<double>(p.rho[i]);
        own.finite = own.finite && std::isfinite(v2 + x + rho);
        if (v2 > v2_most) v2_most = v2, own.fastest = p.id[i];
        a2_most = std::max(a2_most, a2);
        own.density = std::max(own.density, rho);
      }
      own.speed = std::sqrt(v2_most);
      own.acceleration = std::sqrt(a2_most);
      pieces[piece] = own;
    });
  });
  return largest_of(pieces);
}

extremes largest_of(std::span<const extremes> each) {
  extremes all;
  for (const extremes& e : each) {
    if (e.speed > all.speed) all.speed = e.speed, all.fastest = e.fastest;
    all.acceleration = std::max(all.acceleration, e.acceleration);
    all.density = std::max(all.density, e.density);
    all.finite = all.finite && e.finite;
  }
  return all;
}

double time_step(const extremes& e, double H, const tait& eos, double cfl) {
  const double h = H / 2, waves = h / (eos.sound_speed(e.density) + e.speed);
  return cfl * (e.acceleration > 0 ? std::min(waves, std::sqrt(h / e.acceleration)) : waves);
}

}  // namespace pairsum::harness

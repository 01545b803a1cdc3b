#include <pairsum/integrators/integrator.hpp>
#include <pairsum/integrators/quantities.hpp>

namespace pairsum {

/// Heun's method (Hairer, Norsett, Wanner, "Solving Ordinary Differential Equations I", sec. II.1):
///   y' = y + dt k(y),   y <- y + dt/2 (k(y) + k(y'))
struct rk2 {
  static constexpr std::string_view name = "rk2";
  static constexpr std::string_view description = "Runge-Kutta of order 2 (Heun): two summations per step";

  static void step(summation& s, double dt, double gravity, const std::function<void()>& evaluate, const team& t) {
    keep(s, 1);
    evaluate();
    each_quantity(s, gravity, t, [&](auto q) {
      q.kept(0) = q.y + q.real(dt / 2) * q.k;
      q.y += q.real(dt) * q.k;
    });
    evaluate();
    each_quantity(s, gravity, t, [&](auto q) { q.y = q.kept(0) + q.real(dt / 2) * q.k; });
  }
};

}  // namespace pairsum

PAIRSUM_INTEGRATOR(rk2)

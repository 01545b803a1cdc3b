#include <pairsum/integrators/integrator.hpp>
#include <pairsum/integrators/quantities.hpp>

namespace pairsum {

/// The classical Runge-Kutta method (Hairer, Norsett, Wanner, "Solving Ordinary Differential Equations I", sec. II.1).
/// The particles carry the old y (copy 0) and the weighted sum of the stages so far (copy 1).
struct rk4 {
  static constexpr std::string_view name = "rk4";
  static constexpr std::string_view description = "classical Runge-Kutta of order 4: four summations per step";

  static void step(summation& s, double dt, double gravity, const std::function<void()>& evaluate, const team& t) {
    keep(s, 2);
    evaluate();
    each_quantity(s, gravity, t, [&](auto q) {
      q.kept(0) = q.y;
      q.kept(1) = q.y + q.real(dt / 6) * q.k;
      q.y += q.real(dt / 2) * q.k;
    });
    for (const double forward : {dt / 2, dt}) {
      evaluate();
      each_quantity(s, gravity, t, [&](auto q) {
        q.kept(1) += q.real(dt / 3) * q.k;
        q.y = q.kept(0) + q.real(forward) * q.k;
      });
    }
    evaluate();
    each_quantity(s, gravity, t, [&](auto q) { q.y = q.kept(1) + q.real(dt / 6) * q.k; });
  }
};

}  // namespace pairsum

PAIRSUM_INTEGRATOR(rk4)

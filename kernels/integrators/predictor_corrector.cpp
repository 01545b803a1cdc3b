#include <pairsum/integrators/integrator.hpp>
#include <pairsum/integrators/quantities.hpp>

namespace pairsum {

/// The predictor-corrector scheme of SPHysics (Monaghan, J. Comput. Phys. 82 (1989) 1; Gomez-Gesteira et al., Comput.
/// Geosci. 48 (2012) 289):  y' = y + dt/2 k(y),   y'' = y + dt/2 k(y'),   y <- 2 y'' - y
struct predictor_corrector {
  static constexpr std::string_view name = "predictor_corrector";
  static constexpr std::string_view description =
      "predictor-corrector of SPHysics: two summations per step, second order";

  static void step(summation& s, double dt, double gravity, const std::function<void()>& evaluate, const team& t) {
    keep(s, 1);
    evaluate();
    each_quantity(s, gravity, t, [&](auto q) {
      q.kept(0) = q.y;
      q.y += q.real(dt / 2) * q.k;
    });
    evaluate();
    each_quantity(s, gravity, t, [&](auto q) { q.y = q.real(2) * (q.kept(0) + q.real(dt / 2) * q.k) - q.kept(0); });
  }
};

}  // namespace pairsum

PAIRSUM_INTEGRATOR(predictor_corrector)

#include <pairsum/integrators/integrator.hpp>
#include <pairsum/integrators/quantities.hpp>

namespace pairsum {

/// Explicit Euler, as in the talk: all rates at the old state, x with the old v.
struct euler {
  static constexpr std::string_view name = "euler";
  static constexpr std::string_view description = "explicit Euler: one summation per step, first order";

  static void step(summation& s, double dt, double gravity, const std::function<void()>& evaluate, const team& t) {
    keep(s, 0);
    evaluate();
    each_quantity(s, gravity, t, [&](auto q) { q.y += q.real(dt) * q.k; });
  }
};

}  // namespace pairsum

PAIRSUM_INTEGRATOR(euler)

#pragma once
#include "integrators/integrator.hpp"
#include "integrators/with_state.hpp"

namespace pairsum {

/// Explicit Euler, as in the talk: all rates at the old state, x with the old v.
struct euler {
  static constexpr std::string_view name = "euler";
  static constexpr std::string_view description = "explicit Euler: one summation per step, first order";

  static void step(summation& s, double dt, double gravity, const std::function<void()>& evaluate, const team& t) {
    evaluate();
    with_state(s,
               [&]<int D, class R>(state<D, R>& st) { advance(st, static_cast<R>(dt), static_cast<R>(gravity), t); });
  }

 private:
  template <int D, class R>
  static void advance(state<D, R>& st, R dt, R gravity, const team& t) {
    const auto rates = st.rates_of_state();
    if (!rates) return;
    auto& p = st.particles();
    constexpr int up = D == 1 ? 0 : 1;
    using columns = Eigen::Map<Eigen::Array<R, Eigen::Dynamic, 1>>;
    using rate_columns = Eigen::Map<const Eigen::Array<R, Eigen::Dynamic, 1>>;
    t.for_pieces(st.fluid_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
      const auto n = static_cast<Eigen::Index>(end - begin);
      for (int d = 0; d < D; ++d) {
        columns x(p.x[d].data() + begin, n), v(p.v[d].data() + begin, n);
        x += dt * v;
        v += dt * (rate_columns(rates.dv[d] + begin, n) - (d == up ? gravity : R(0)));
      }
      columns(p.rho.data() + begin, n) += dt * rate_columns(rates.drho + begin, n);
    });
  }
};

}  // namespace pairsum

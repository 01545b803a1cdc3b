#pragma once
#include <Eigen/Core>

#include <pairsum/integrators/with_state.hpp>

namespace pairsum {

/// One quantity of a piece of the fluid (a component of x or v, or rho) in a stage of a time step.
template <class R, class Rate>
struct quantity {
  using columns = Eigen::Map<Eigen::Array<R, Eigen::Dynamic, 1>>;
  columns y;  ///< its value
  Rate k;     ///< its rate at the state that was evaluated last: v, dv + gravity, or drho
  columns kept0, kept1;

  /// The copies that travel with the particles from stage to stage: 0 and 1 of those that keep() made room for.
  columns& kept(int copy) { return copy == 0 ? kept0 : kept1; }
  /// A time in the working precision.
  static R real(double a) { return static_cast<R>(a); }
};

/// Lets every particle carry `copies` (0 to 2) values of each quantity through the sorting of the stages to come.
inline void keep(summation& s, int copies) {
  with_state(s, [&]<int D, class R>(state<D, R>& st) {
    st.particles().carry(static_cast<std::size_t>(copies) * (2 * D + 1));
  });
}

/// Calls f(quantity) for each quantity of the fluid, positions before velocities, so that f may write y while the rates
/// of the others still stand. Does nothing for an interaction without rates drho and dv. `gravity` in m/s2 acts along
/// -y, in 1D along -x.
template <class F>
void each_quantity(summation& s, double gravity, const team& t, F&& f) {
  with_state(s, [&]<int D, class R>(state<D, R>& st) {
    const auto rates = st.rates_of_state();
    if (!rates) return;
    auto& p = st.particles();
    constexpr int up = D == 1 ? 0 : 1, quantities = 2 * D + 1;
    using columns = Eigen::Map<Eigen::Array<R, Eigen::Dynamic, 1>>;
    using rate_columns = Eigen::Map<const Eigen::Array<R, Eigen::Dynamic, 1>>;
    t.for_pieces(st.fluid_count(), [&](std::size_t begin, std::size_t end, std::size_t) {
      const auto n = static_cast<Eigen::Index>(end - begin);
      int number = 0;
      const auto one = [&](column<R>& y, const auto& rate) {
        const auto kept = [&](int copy) {
          const auto at = static_cast<std::size_t>(copy * quantities + number);
          return at < p.carried.size() ? columns(p.carried[at].data() + begin, n) : columns(nullptr, 0);
        };
        f(quantity<R, std::remove_cvref_t<decltype(rate)>>{columns(y.data() + begin, n), rate, kept(0), kept(1)});
        ++number;
      };
      for (int d = 0; d < D; ++d) one(p.x[d], rate_columns(p.v[d].data() + begin, n));
      for (int d = 0; d < D; ++d)
        one(p.v[d], rate_columns(rates.dv[d] + begin, n) - (d == up ? static_cast<R>(gravity) : R(0)));
      one(p.rho, rate_columns(rates.drho + begin, n));
    });
  });
}

}  // namespace pairsum

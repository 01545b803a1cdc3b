#pragma once
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include <pairsum/formula/costs_of.hpp>
#include <pairsum/formula/mixed.hpp>
#include <pairsum/formula/rate_names.hpp>
#include <pairsum/reference/cell_search.hpp>
#include <pairsum/reference/running_error.hpp>
#include <pairsum/sum/omega.hpp>
#include <pairsum/sum/reference.hpp>
#include <pairsum/sum/setup.hpp>

namespace pairsum {

/// The reference for one interaction in one precision. Terms are evaluated in R, with bounds for the precision of pairs
/// (float in mixed, whose boundary pairs are in double), sums run in long double. A backend's rate may differ by its
/// terms' errors, the reference's own, and the backend's n additions in any order:
///   |rate - value| <= 2 sum e_k + n u / (1 - n u) * sum (|t_k| + 2 e_k)           (Higham, sec. 4.2)
template <class I>
class reference_of final : public reference {
  using R = typename I::real;
  using tracked = running_error<R, pair_real<I>>;  ///< in a pair
  using own = running_error<R>;                    ///< in the data of a particle, and at the boundary
  static constexpr int D = I::dim;
  using rates = typename I::template rates<tracked>;
  static constexpr int slots = field_count<rates>;

 public:
  explicit reference_of(const setup& s)
      : formula_(s.constants),
        H_(static_cast<R>(s.constants.H)),
        omega_(make_box<D, R>(s)),
        torus_(make_torus<D, R>(s)) {}

  expectation brute_force(const particle_table& table, const team& t, std::vector<std::uint32_t> ids) const override {
    const input w(*this, table, ids.empty());
    if (ids.empty()) ids = w.fluid;
    return evaluate(w, ids, t, [&](std::uint32_t, auto&& meet) {
      for (std::uint32_t j = 0; j < table.size(); ++j) meet(j);
    });
  }

  expectation cell_search(const particle_table& table, const team& t) const override {
    const input w(*this, table, true);
    const cell_search_of<D, R> s(w.x, w.kind, H_, omega_);
    return evaluate(w, w.fluid, t, [&](std::uint32_t i, auto&& meet) { s.around(w.x[i], meet); });
  }

  formula_costs costs() const override { return costs_of(formula_); }

 private:
  /// The particles, rounded to R; their data for pairs are derived on demand, or beforehand for all.
  struct input {
    const reference_of& f;
    const particle_table& table;
    std::vector<vec<D, R>> x;
    std::vector<typename I::template particle<tracked>> derived;
    const std::vector<particle_kind>& kind;
    std::vector<std::uint32_t> fluid;

    input(const reference_of& owner, const particle_table& t, bool derive_all)
        : f(owner), table(t), x(t.size()), kind(t.kind) {
      for (std::uint32_t i = 0; i < t.size(); ++i) {
        for (int d = 0; d < D; ++d) {
          x[i][d] = static_cast<R>(t.x[d][i]);
          if (f.omega_.periodic[d]) x[i][d] = f.omega_.wrapped(d, x[i][d]);
        }
        if (kind[i] == particle_kind::fluid) fluid.push_back(i);
      }
      if (!derive_all) return;
      derived.resize(t.size());
      for (const std::uint32_t i : fluid) derived[i] = derive(i);
    }
    template <class T>
    particle_state<D, T> state(std::uint32_t i) const {
      particle_state<D, T> s;
      for (int d = 0; d < D; ++d) {
        s.x[d] = x[i][d];
        s.v[d] = static_cast<R>(table.v[d][i]);
      }
      s.rho = static_cast<R>(table.rho[i]);
      s.m = static_cast<R>(table.m[i]);
      s.id = i;
      return s;
    }
    typename I::template particle<tracked> particle(std::uint32_t i) const {
      return derived.empty() ? derive(i) : derived[i];
    }
    auto boundary(std::uint32_t i) const { return f.formula_.derive_boundary(state<own>(i)); }
    typename I::template particle<tracked> derive(std::uint32_t i) const {
      if constexpr (is_mixed<I>) {
        return each_as<tracked>(f.formula_.derive(state<own>(i)), [](const own& a) {
          return tracked(a.v, a.e + tracked::rounded(a.v) + tracked::underflow);
        });
      } else {
        return f.formula_.derive(state<tracked>(i));
      }
    }
  };

  struct sums {
    std::array<long double, slots> value{}, magnitude{}, error{};
    std::size_t terms = 0;

    template <class Rates>
    void take(const Rates& one, const Rates* other = nullptr) {
      ++terms;
      std::array<double, slots> e;
      each_scalar(one, [&](const auto& t, int k) {
        value[k] += plain(t);
        magnitude[k] += std::abs(plain(t));
        e[k] = error_of(t);
      });
      if (other) each_scalar(*other, [&](const auto& t, int k) { e[k] = std::max(e[k], error_of(t)); });
      for (int k = 0; k < slots; ++k) error[k] += e[k];
    }
    template <class U>
    static long double plain(const running_error<R, U>& t) {
      return t.v;
    }
    template <class U>
    static double error_of(const running_error<R, U>& t) {
      return t.e;
    }
    static long double plain(std::uint64_t n) { return n; }
    static double error_of(std::uint64_t) { return 0; }
  };

  template <class Candidates>
  expectation evaluate(const input& w, const std::vector<std::uint32_t>& ids, const team& t,
                       Candidates&& candidates) const {
    expectation out;
    out.names = rate_names<I>();
    out.ids = ids;
    for (auto* c : {&out.value, &out.bound, &out.magnitude}) c->assign(slots, std::vector<double>(ids.size()));
    const bool exact = sums_integers();
    const R boundary_reach = static_cast<R>(pairsum::boundary_reach<I>()) * H_;
    std::atomic<std::uint64_t> fluid_sides = 0, boundary_pairs = 0;
    constexpr std::size_t piece = 256;
    t.for_each((ids.size() + piece - 1) / piece, [&](std::size_t p) {
      std::uint64_t sides = 0, walls = 0;
      for (std::size_t k = p * piece; k < std::min(ids.size(), (p + 1) * piece); ++k) {
        const std::uint32_t i = ids[k];
        sums s;
        const auto a_i = w.particle(i);
        candidates(i, [&](std::uint32_t j) {
          if (j == i || w.kind[j] == particle_kind::lost) return;
          vec<D, R> r = w.x[i] - w.x[j];
          if (torus_.periodic) torus_.to_minimum_image(r);
          const R r2 = norm2<D, R>(r);
          if (!(r2 < H_ * H_)) return;
          if (w.kind[j] == particle_kind::boundary) {
            ++walls;
            if constexpr (has_boundary<I>) {
              if (!(r2 < boundary_reach * boundary_reach)) return;
              vec<D, own> rt;
              for (int d = 0; d < D; ++d) rt[d] = own(r[d], own::rounded(r[d]));
              const own r2t(r2, (D + 2) * own::rounded(r2));
              const auto brought = each_as<own>(a_i, [](const tracked& a) { return own(a.v, a.e); });
              s.take(formula_.boundary(rt, r2t, brought, w.boundary(j)));
            }
          } else {
            ++sides;
            vec<D, tracked> rt;
            for (int d = 0; d < D; ++d) rt[d] = tracked(r[d], error_of_component(r[d]));
            const tracked r2t(r2, error_of_square(r, r2));
            const auto a_j = w.particle(j);
            const vec<D, tracked> back = -rt;
            const auto seen_from_j = formula_.pair(back, r2t, a_j, a_i).to_j;
            s.take(formula_.pair(rt, r2t, a_i, a_j).to_i, &seen_from_j);
          }
        });
        const double n = static_cast<double>(s.terms);
        const double u = 0.5 * static_cast<double>(std::numeric_limits<R>::epsilon());
        for (int c = 0; c < slots; ++c) {
          out.value[c][k] = static_cast<double>(s.value[c]);
          out.magnitude[c][k] = static_cast<double>(s.magnitude[c]);
          out.bound[c][k] =
              exact ? 0 : static_cast<double>(2 * s.error[c] + n * u / (1 - n * u) * (s.magnitude[c] + 2 * s.error[c]));
        }
      }
      fluid_sides += sides;
      boundary_pairs += walls;
    });
    out.pairs_fluid_fluid = fluid_sides / 2;
    out.pairs_fluid_boundary = boundary_pairs;
    return out;
  }

  /// The data of a particle, with f applied to each scalar (but not to whole numbers).
  template <class T, class Particle, class F>
  static typename I::template particle<T> each_as(const Particle& a, F&& f) {
    if constexpr (std::is_same_v<Particle, typename I::template particle<T>>) {
      return a;
    } else {
      std::array<T, field_count<Particle>> values;
      each_scalar(a, [&](const auto& v, int k) { values[k] = f(v); });
      typename I::template particle<T> same;
      each_scalar(same, [&](T& v, int k) { v = values[k]; });
      return same;
    }
  }

  /// How far x_i - x_j of a backend may be from ours. A mixed one rounds either position to a whole number, and their
  /// difference to float; in a periodic box also the unit they are counted in, and once more.
  double error_of_component(R r) const {
    if constexpr (is_mixed<I>)
      return (torus_.periodic ? 3.03 : 1.01) * tracked::rounded(r) +
             static_cast<double>(H_) * (1 / mixed_places_per_reach);
    else
      return tracked::rounded(r);
  }
  double error_of_square(const vec<D, R>& r, R r2) const {
    double error = (D + 2) * tracked::rounded(r2);
    if constexpr (is_mixed<I>)
      for (int d = 0; d < D; ++d)
        error += 2.01 * std::abs(r[d]) * error_of_component(r[d]) + std::pow(error_of_component(r[d]), 2);
    return error;
  }

  /// Are the rates whole numbers, which have no rounding?
  static bool sums_integers() {
    bool all = true;
    each_scalar(zero<rates>(),
                [&](const auto& a, int) { all = all && std::is_integral_v<std::remove_cvref_t<decltype(a)>>; });
    return all;
  }

  I formula_;
  R H_;
  box<D, R> omega_;
  torus<D, R> torus_;
};

}  // namespace pairsum

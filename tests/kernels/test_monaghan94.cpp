#include <pairsum/interactions/monaghan94.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include <pairsum/core/random.hpp>
#include <pairsum/smoothing/wendland_c2.hpp>

// Monaghan's formula against its documentation, written down here a second time.
namespace pairsum {
namespace {

template <int D, class R>
struct world {
  static constexpr int dim = D;
  using real = R;
};
using worlds = testing::Types<world<1, double>, world<2, double>, world<3, double>, world<1, float>, world<2, float>,
                              world<3, float>>;

template <class World>
class monaghan94_test : public testing::Test {
 protected:
  static constexpr int D = World::dim;
  using R = typename World::real;
  using formula = monaghan94<D, R, wendland_c2>;
  using state = particle_state<D, R>;
  using rates = typename formula::template rates<R>;
  using wide = vec<D, double>;
  static constexpr double H = 0.1;
  const formula f{physics{H, {}}};

  /// A particle in a box whose diagonal is 0.86 H.
  static state random_particle(std::uint64_t n) {
    const counter_random random(94);
    state s;
    for (std::uint64_t d = 0; d < D; ++d) {
      s.x[d] = R(random.uniform(10 * n + d, 0, 0.86 * H / std::sqrt(D)));
      s.v[d] = R(random.uniform(10 * n + 3 + d, -1, 1));
    }
    s.rho = R(random.uniform(10 * n + 6, 950, 1050));
    s.m = R(random.uniform(10 * n + 7, 1e-4, 3e-4));
    s.id = 0;
    return s;
  }
  static wide apart(const state& i, const state& j) {
    const vec<D, R> r = i.x - j.x;
    return r.template cast<double>();
  }
  static double approach(const state& i, const state& j) {
    return -apart(i, j).dot((i.v - j.v).template cast<double>());
  }
  /// Gradient of Wendland's C2 function.
  static wide gradient(const wide& r) {
    const double q = r.norm() / H, s = 1 - q, pi = std::numbers::pi;
    const double slope = D == 1   ? -12 * q * s * s * 5 / (4 * H)
                         : D == 2 ? -20 * q * s * s * s * 7 / (pi * H * H)
                                  : -20 * q * s * s * s * 21 / (2 * pi * H * H * H);
    return slope / H * r / r.norm();
  }

  /// What j adds to i, `drho` and `dv`, and how exact they can be in the working precision.
  struct expected {
    double drho, drho_error;
    wide dv;
    double dv_error;
  };
  static expected by_hand(const state& i, const state& j, bool viscous = true) {
    const double rho_i = i.rho, rho_j = j.rho, m_j = j.m, h = H / 2;
    const auto p = [](double rho) { return 1e4 * (std::pow(rho / 1000, 7) - 1); };
    const auto c = [](double rho) { return std::sqrt(70 * std::pow(rho / 1000, 6)); };
    const wide r = apart(i, j), v = i.v.template cast<double>() - j.v.template cast<double>(), grad = gradient(r);
    const double mu = h * v.dot(r) / (r.squaredNorm() + 0.01 * h * h);
    double Pi = 0;
    if (viscous && v.dot(r) < 0) Pi = -0.01 * (c(rho_i) + c(rho_j)) / 2 * mu / ((rho_i + rho_j) / 2);
    const double a = p(rho_i) / (rho_i * rho_i) + p(rho_j) / (rho_j * rho_j) + Pi;
    // The pressure is a difference of terms of the size of B.
    const double unit = 256 * std::numeric_limits<R>::epsilon() * m_j * grad.norm();
    return {m_j * v.dot(grad), unit * v.norm(), -m_j * a * grad, unit * (2 * 1e4 / (rho_i * rho_i) + Pi)};
  }
  static bool agree(const rates& u, const expected& e) {
    return std::abs(u.drho - e.drho) <= e.drho_error && (u.dv.template cast<double>() - e.dv).norm() <= e.dv_error;
  }
  auto pair(const state& i, const state& j) const {
    const vec<D, R> r = i.x - j.x;
    return f.pair(r, norm2<D, R>(r), f.derive(i), f.derive(j));
  }
  rates wall(const vec<D, R>& r) const {
    return f.boundary(r, norm2<D, R>(r), f.derive(random_particle(1)), f.derive_boundary(random_particle(2)));
  }
  static vec<D, R> along_last_axis(double length) {
    vec<D, R> r = vec<D, R>::Zero();
    r[D - 1] = R(length);
    return r;
  }
};
TYPED_TEST_SUITE(monaghan94_test, worlds);

TYPED_TEST(monaghan94_test, pair_is_the_documented_formula_for_both_sides) {
  int approaching = 0, without_viscosity = 0;
  for (std::uint64_t n = 0; n < 400; ++n) {
    const auto a = this->random_particle(2 * n), b = this->random_particle(2 * n + 1);
    const auto u = this->pair(a, b);
    ASSERT_TRUE(this->agree(u.to_i, this->by_hand(a, b))) << n;
    ASSERT_TRUE(this->agree(u.to_j, this->by_hand(b, a))) << n;
    const bool approach = this->approach(a, b) > 0, same = this->agree(u.to_i, this->by_hand(a, b, false));
    approaching += approach;
    without_viscosity += same;
    if (!approach) {
      EXPECT_TRUE(same) << "viscosity of particles that part";
    }
  }
  EXPECT_GT(approaching, 100);
  EXPECT_LT(approaching, 300);
  EXPECT_LT(without_viscosity, 400 - approaching * 9 / 10) << "a formula without viscosity is rejected";
}

TYPED_TEST(monaghan94_test, coincident_fluid_particles_exert_no_force) {
  auto a = this->random_particle(1), b = this->random_particle(2);
  b.x = a.x;
  const auto u = this->pair(a, b);
  EXPECT_EQ(u.to_i.drho, 0);
  EXPECT_EQ(u.to_j.drho, 0);
  EXPECT_EQ(u.to_i.dv.norm(), 0);
  EXPECT_EQ(u.to_j.dv.norm(), 0);
}

/// D ((r0/r)^4 - (r0/r)^2)/r away from the wall, D = 100 m2/s2, r0 = H/4; other powers are rejected.
TYPED_TEST(monaghan94_test, walls_repel_as_lennard_and_jones_have_it) {
  using R = typename TestFixture::R;
  constexpr double r0 = TestFixture::H / 4, epsilon = std::numeric_limits<R>::epsilon();
  static_assert(TestFixture::formula::boundary_reach == 0.25);
  static_assert(boundary_is_singular<typename TestFixture::formula>());
  for (std::uint64_t n = 0; n < 400; ++n) {
    const auto any = TestFixture::apart(this->random_particle(2 * n), this->random_particle(2 * n + 1));
    const vec<TestFixture::D, R> r =
        (any / any.norm() * r0 * (0.02 + 0.97 * static_cast<double>(n) / 400)).template cast<R>();
    const auto u = this->wall(r);
    const auto agrees = [&](int p1, int p2) {
      const auto exact = r.template cast<double>().eval();
      const double s = r0 / exact.norm(), unit = 100 / exact.squaredNorm();
      const auto dv = (unit * (std::pow(s, p1) - std::pow(s, p2)) * exact).eval();
      return (u.dv.template cast<double>() - dv).norm() <= 32 * epsilon * unit * std::pow(s, p1) * exact.norm();
    };
    EXPECT_EQ(u.drho, 0);
    EXPECT_TRUE(agrees(4, 2)) << n;
    EXPECT_FALSE(agrees(6, 4)) << n;
    EXPECT_GT(u.dv.dot(r), 0) << "repulsion";
  }
}

TYPED_TEST(monaghan94_test, walls_end_at_r0) {
  using R = typename TestFixture::R;
  const typename TestFixture::formula f(physics{0.5, {}});
  const auto at = [&](double length) {
    const auto r = this->along_last_axis(length);
    const R r2 = norm2<TestFixture::D, R>(r);
    return f.boundary(r, r2, f.derive(this->random_particle(1)), f.derive_boundary(this->random_particle(2)));
  };
  EXPECT_EQ(at(0.125).dv.norm(), 0);
  EXPECT_EQ(at(0.125).drho, 0);
  EXPECT_GT(at(0.1249).dv[TestFixture::D - 1], 0);
  EXPECT_LT(at(-0.1249).dv[TestFixture::D - 1], 0);
}

}  // namespace
}  // namespace pairsum

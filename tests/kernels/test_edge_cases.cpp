#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cloud.hpp"

// The smallest, the densest and the impossible worlds, in every dimension and precision: a clear result or a clear
// error.
namespace pairsum {
namespace {

using namespace test_kit;
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

class edge_cases_test : public testing::TestWithParam<formula_choice> {
 protected:
  const formula_choice& f = GetParam();
  const std::string some_backend = "symmetric_omp";

  scene some(shape form, std::uint32_t fluid, std::uint32_t boundary, double length) const {
    cloud c;
    c.dim = f.dim;
    c.form = form;
    c.fluid = fluid;
    c.boundary = boundary;
    c.length = length;
    return make_cloud(c);
  }
  /// Every backend; with other smoothing kernels those that call each of a formula's functions.
  void expect_agreement(const scene& s) const {
    const expectation e =
        registry::instance().make_reference(with(s.world, f))->brute_force(s.particles, some_threads());
    const bool usual = f.smoothing == "wendland_c2" || f.smoothing == "none";
    for (const std::string& backend : usual ? backends_for(f) : callers) {
      std::vector<std::string> isas = isas_for(f, backend);
      isas.resize(std::min<std::size_t>(isas.size(), 2));  // scalar, and the best
      for (const std::string& isa : isas)
        for (const grid_choice& grid : every_grid({3})) {
          setup world = with(s.world, f, backend, grid);
          world.isa = isa;
          EXPECT_EQ(disagreement(evaluated(world, s.particles, 3)->rates(), e), "")
              << backend << " " << isa << " " << grid;
        }
    }
  }
  std::string refusal(const scene& s) const {
    return error_of([&] { (void)evaluated(with(s.world, f, some_backend, 3), s.particles); });
  }
};
INSTANTIATE_TEST_SUITE_P(every, edge_cases_test, testing::ValuesIn(formulas()),
                         [](const auto& i) { return testing::PrintToString(i.param); });

TEST_P(edge_cases_test, no_particle_and_one) {
  expect_agreement(some(shape::uniform, 0, 0, 3));
  expect_agreement(some(shape::uniform, 0, 9, 3));
  expect_agreement(some(shape::uniform, 1, 0, 3));
  for (const auto& column :
       evaluated(with(some(shape::uniform, 1, 0, 3).world, f, some_backend, 3), some(shape::uniform, 1, 0, 3).particles)
           ->rates()
           .columns)
    EXPECT_EQ(column, std::vector<double>{0});
}

TEST_P(edge_cases_test, all_in_one_cell) { expect_agreement(some(shape::one_cell, 150, 40, 5)); }

TEST_P(edge_cases_test, H_larger_than_Omega) { expect_agreement(some(shape::uniform, 80, 30, 0.3)); }

TEST_P(edge_cases_test, coincident_fluid_is_legal_and_exerts_no_force) {
  scene s = some(shape::coincident, 60, 0, 5);
  expect_agreement(s);
  for (auto& x : s.particles.x) x.assign(x.size(), x.front());  // all 60 on one point
  const rate_table u = evaluated(with(s.world, f, some_backend, 3), s.particles)->rates();
  for (std::size_t i = 0; i < 60; ++i)
    for (std::size_t c = 0; c < u.columns.size(); ++c) {
      if (f.interaction == "count" && c == 0) {
        EXPECT_EQ(u.columns[c][i], 59);
      }
      if (u.names[c].starts_with("dv")) {
        EXPECT_EQ(u.columns[c][i], 0) << u.names[c];
      }
      EXPECT_TRUE(std::isfinite(u.columns[c][i]));
    }
}

TEST_P(edge_cases_test, fluid_on_a_boundary_particle_is_refused_where_the_force_is_infinite) {
  scene s = some(shape::uniform, 40, 20, 3);
  for (auto& x : s.particles.x) x[45] = x[17];
  if (f.interaction != "monaghan94") return expect_agreement(s);
  EXPECT_TRUE(says(refusal(s), {"fluid particle 17", "boundary particle 45", "monaghan94"})) << refusal(s);
  EXPECT_EQ(refusal(s).find('\n'), std::string::npos);
  s.particles.x[0][45] += 1e-3;
  EXPECT_EQ(refusal(s), "");
}

/// Two points that only the working precision makes one.
TEST_P(edge_cases_test, apart_in_double_may_be_coincident_in_float) {
  scene s = some(shape::uniform, 40, 20, 3);
  for (auto& x : s.particles.x) x[45] = x[17] = 0.1;
  s.particles.x[0][45] = std::nextafter(0.1, 1.0);
  const bool refused = f.interaction == "monaghan94" && f.precision == "float";
  EXPECT_EQ(refusal(s) != "", refused) << refusal(s);
}

TEST_P(edge_cases_test, impossible_worlds_are_refused_in_one_line) {
  const scene good = some(shape::uniform, 30, 10, 3);
  const auto expect_refusal = [&](auto change, const std::vector<std::string>& words) {
    scene s = good;
    change(s);
    EXPECT_TRUE(says(refusal(s), words)) << refusal(s);
    EXPECT_EQ(refusal(s).find('\n'), std::string::npos);
  };
  for (const double bad : {nan, inf, -inf}) {
    expect_refusal([&](scene& s) { s.particles.x[f.dim - 1][3] = bad; }, {"particle 3", "position", "not finite"});
    expect_refusal([&](scene& s) { s.particles.v[0][3] = bad; }, {"particle 3", "velocity", "not finite"});
  }
  for (const double bad : {0.0, -0.1, nan, inf})
    expect_refusal([&](scene& s) { s.world.constants.H = bad; }, {"support radius H"});
  expect_refusal([&](scene& s) { s.particles.x[0][3] = -5, s.particles.x[0][4] = 7; },
                 {"2 of 40 particles lie outside Omega"});
  for (const double bad : {1e-80, 1e80})
    expect_refusal([&](scene& s) { s.world.constants.H = bad; }, {"support radius H", f.precision});
}

/// What does not fit into float, but into double.
TEST_P(edge_cases_test, H_must_fit_the_precision) {
  const scene tiny = [&] {
    scene s = some(shape::uniform, 5, 0, 1);
    s.world.constants.H = 1e-12;
    for (auto& x : s.particles.x)
      for (double& a : x) a *= 1e-12;
    s.world.omega_low.assign(f.dim, 0);
    s.world.omega_high.assign(f.dim, 1e-11);
    return s;
  }();
  EXPECT_EQ(refusal(tiny) != "", f.precision != "double") << refusal(tiny);
  scene far = some(shape::uniform, 5, 0, 1);
  for (auto& x : far.particles.x) x.assign(x.size(), 1e39);
  far.world.omega_high.assign(f.dim, 1e40);
  EXPECT_EQ(refusal(far) != "", f.precision == "float") << refusal(far);
}

}  // namespace
}  // namespace pairsum

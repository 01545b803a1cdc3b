#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pairsum/sum/check.hpp>
#include "scene.hpp"

namespace pairsum {
namespace {

using namespace test_kit;
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

class check_input_test : public testing::Test {
 protected:
  scene s = make_scene("dam_break", 0.08, "perturbed");
  particle_table& p = s.particles;
  std::string refusal() const {
    return error_of([&] { check_input(s.particles, s.world); });
  }
  void expect_refusal(const std::vector<std::string>& words) const {
    EXPECT_TRUE(says(refusal(), words)) << "\"" << refusal() << "\"";
  }
};

TEST_F(check_input_test, accepts_a_case) { EXPECT_EQ(refusal(), ""); }

TEST_F(check_input_test, columns_must_be_of_one_length) {
  const std::string n = std::to_string(p.size());
  const std::pair<const char*, std::vector<double>*> columns[] = {
      {"x_x", &p.x[0]}, {"x_z", &p.x[2]}, {"v_y", &p.v[1]}, {"rho", &p.rho}, {"m", &p.m}};
  for (const auto& [name, column] : columns)
    for (const std::size_t rows : {p.size() - 1, p.size() + 1, std::size_t{0}}) {
      const std::vector<double> keep = *column;
      column->resize(rows, 1);
      const std::string expected =
          std::string("column ") + name + " of the particles has " + std::to_string(rows) + " rows, must have " + n;
      EXPECT_EQ(refusal(), expected);
      EXPECT_EQ(error_of([&] { registry::instance().make_summation(s.world)->load(p, {}); }), expected);
      *column = keep;
    }
  p.v.pop_back();
  EXPECT_EQ(refusal(), "v of the particles has 2 columns, must have 3");
}

TEST_F(check_input_test, names_the_particle_and_what_is_not_finite) {
  for (const double bad : {nan, inf, -inf}) {
    for (int d = 0; d < 3; ++d) {
      scene keep = s;
      p.x[d][17] = bad;
      expect_refusal({"particle 17", "position", "not finite"});
      s = keep;
      p.v[d][18] = bad;
      expect_refusal({"particle 18", "velocity", "not finite"});
      s = keep;
    }
    p.rho[19] = bad;
    expect_refusal({"particle 19", "density", "not finite"});
    p.rho[19] = 1000;
    p.m[20] = bad;
    expect_refusal({"particle 20", "mass", "not finite"});
    p.m[20] = 1;
  }
}

TEST_F(check_input_test, mass_and_density_must_be_positive) {
  p.m[5] = -1;
  expect_refusal({"particle 5", "mass of -1", "must be positive"});
  p.m[5] = 0;
  expect_refusal({"particle 5", "mass of 0", "must be positive"});
  p.m[5] = 1;
  p.rho[6] = 0;
  expect_refusal({"particle 6", "density of 0", "must be positive"});
  p.rho[6] = -1000;
  expect_refusal({"particle 6", "density of -1000", "must be positive"});
}

TEST_F(check_input_test, float_must_hold_what_double_holds) {
  p.v[1][7] = 1e39;
  EXPECT_EQ(refusal(), "");
  s.world.precision = "float";
  expect_refusal({"particle 7", "velocity", "not finite in float"});
  p.v[1][7] = 0;
  p.rho[8] = 1e-60;
  expect_refusal({"particle 8", "density of 1e-60", "positive in float"});
  p.rho[8] = 1000;
  EXPECT_EQ(refusal(), "");
}

TEST_F(check_input_test, boundary_particles_are_checked_too) {
  p.rho.back() = -1;
  expect_refusal({"particle " + std::to_string(p.size() - 1), "density"});
}

TEST_F(check_input_test, particles_outside_omega_are_counted) {
  p.x[0][1] = -1e-9;
  p.x[1][2] = 1.9;
  p.x[2][3] = 5;
  expect_refusal({"3 of " + std::to_string(p.size()) + " particles lie outside Omega"});
  p.x[0][1] = 0;
  p.x[1][2] = 1.8;
  p.x[2][3] = 0.61;
  EXPECT_EQ(refusal(), "") << "Omega is closed";
  p.x[1][2] = 1.9;
  expect_refusal({"1 of"});
  s.world.periodic.on[1] = true;
  EXPECT_EQ(refusal(), "") << "it comes back";
  EXPECT_EQ(drop_outside(p, s.world), 0u);
}

TEST_F(check_input_test, the_world_must_be_usable) {
  for (const double H : {0.0, -1.0, nan, inf}) {
    s.world.constants.H = H;
    expect_refusal({"support radius H must be a positive length"});
    EXPECT_NE(error_of([&] { (void)registry::instance().make_summation(s.world); }), "") << H;
  }
  s.world.constants.H = 0.1;
  s.world.omega_high[1] = -1;
  expect_refusal({"Omega", "component 1"});
  EXPECT_NE(error_of([&] { (void)registry::instance().make_summation(s.world); }), "");
  s.world.omega_high[1] = nan;
  expect_refusal({"Omega", "finite"});
  s.world.omega_high = {3.3, 1.8};
  EXPECT_TRUE(says(error_of([&] { (void)registry::instance().make_summation(s.world); }), {"corners of 3 components"}));
  s.world.omega_high = {3.3, 1.8, 0.61};
  s.world.dim = 2;
  expect_refusal({"3D", "2D"});
  s.world.omega_high = s.world.omega_low = {0, 0};
  s.world.periodic.on[2] = true;
  EXPECT_TRUE(says(error_of([&] { check_domain(s.world); }), {"a 2D domain has no axis z that could be periodic"}));
}

TEST_F(check_input_test, drop_outside_keeps_the_others_in_order) {
  const particle_table before = p;
  p.x[0][1] = -1;
  p.x[1][4] = nan;
  p.x[2].back() = 7;
  EXPECT_EQ(drop_outside(p, s.world), 3u);
  ASSERT_EQ(p.size(), before.size() - 3);
  EXPECT_EQ(refusal(), "");
  std::size_t k = 0;
  for (std::size_t i = 0; i + 1 < before.size(); ++i) {
    if (i == 1 || i == 4) continue;
    for (int d = 0; d < 3; ++d) {
      ASSERT_EQ(p.x[d][k], before.x[d][i]);
      ASSERT_EQ(p.v[d][k], before.v[d][i]);
    }
    ASSERT_EQ(p.rho[k], before.rho[i]);
    ASSERT_EQ(p.m[k], before.m[i]);
    ASSERT_EQ(p.kind[k], before.kind[i]);
    ++k;
  }
  EXPECT_EQ(drop_outside(p, s.world), 0u);
}

TEST_F(check_input_test, a_failing_load_changes_nothing) {
  for (const std::string& name : backend_names()) {
    const auto sum = evaluated(with(s.world, name, 4), s.particles, 2);
    workers w(sum->traits().threads, 2);
    const auto before = sum->fingerprint();
    const particle_table was = sum->snapshot();
    particle_table bad = s.particles;
    bad.resize(bad.size() - 100);
    bad.m[50] = nan;
    EXPECT_TRUE(says(error_of([&] { sum->load(bad, {}); }), {"particle 50", "mass"})) << name;
    EXPECT_EQ(sum->fingerprint(), before);
    EXPECT_EQ(sum->snapshot().x, was.x);
    sum->evaluate(w.get());
    if (sum->traits().deterministic) {
      EXPECT_EQ(sum->fingerprint(), before) << name;
    }
  }
}

}  // namespace
}  // namespace pairsum

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <pairsum/core/precision.hpp>
#include <pairsum/core/random.hpp>
#include <pairsum/grid/hashed_grid.hpp>
#include "scene.hpp"

// Particles where a grid errs first: within a few ulps of the faces of its cells, and of faces H apart, with a partner
// at H give or take a few ulps. No pair may be missed or summed twice.
namespace pairsum {
namespace {

using namespace test_kit;

/// `particles` in a box of `faces` cells along each axis, which the grid does not fold.
template <int Dim, class Real, std::uint32_t Particles, int Faces, int Bits>
struct world {
  static constexpr int D = Dim, faces = Faces, M = Bits;
  using R = Real;
  static constexpr std::uint32_t particles = Particles;
};
#ifdef __SANITIZE_ADDRESS__  // many times slower
using largest = world<3, double, 300'000, 46, 6>;
#else
using largest = world<3, double, 1'000'000, 70, 7>;
#endif
using worlds = testing::Types<world<1, double, 100'000, 30'000, 16>, world<1, float, 100'000, 30'000, 16>,
                              world<2, double, 200'000, 250, 9>, world<2, float, 200'000, 250, 9>, largest,
                              world<3, float, 300'000, 46, 6>>;

template <class World>
class cell_faces_test : public testing::Test {
 protected:
  static constexpr int D = World::D;
  using R = typename World::R;
  using point = vec<D, R>;
  static constexpr std::uint32_t pairs = World::particles / 2;
  static constexpr R far = std::numeric_limits<R>::infinity();
  static constexpr std::array<R, 3> corner{R(-0.7), R(0), R(0.3)};
  const R H = R(0.013);
  scene s;

  void SetUp() override {
    const auto has = [](const auto& all, const auto& one) { return std::ranges::find(all, one) != all.end(); };
    const registry& built = registry::instance();
    if (!has(built.dims(), D) || !has(built.precisions(), std::string(precision_name<R>())) ||
        !has(built.interactions(), std::string("count")))
      GTEST_SKIP() << "not built";
    s.world = with(s.world, "naive", World::M, "count");
    s.world.dim = D;
    s.world.precision = precision_name<R>();
    s.world.constants.H = H;
    for (int d = 0; d < D; ++d) {
      s.world.omega_low.push_back(corner[d]);
      s.world.omega_high.push_back(corner[d] + (World::faces + 4) * H * (1 + 32 * World::faces * epsilon));
    }
    place_all();
  }
  static constexpr R epsilon = std::numeric_limits<R>::epsilon();

  /// a, a few ulps to either side.
  static R nearby(R a, std::uint64_t bits) {
    const R way = bits & 1 ? far : -far;
    for (auto ulps = (bits >> 1) % 4; ulps > 0; --ulps) a = std::nextafter(a, way);
    return a;
  }

  /// Particle n lies at faces, its partner n + pairs at distance H; the last quarter of the partners is boundary.
  void place_all() {
    box<D, R> omega;
    for (int d = 0; d < D; ++d) omega.low[d] = corner[d], omega.high[d] = R(s.world.omega_high[d]);
    const R width = hashed_grid<D, R>(omega, H, World::M).cell_width();
    s.particles = particle_table(D);
    s.particles.resize(2 * std::size_t{pairs});
    for (std::uint64_t n = 0; n < pairs; ++n) {
      const counter_random random(n, 7);
      const R face = random.bits(0) & 1 ? width : H;
      point x, step;
      const auto way = random.bits(1) % (D == 1 ? 2 : D == 2 ? 8 : 26) + 1;  // axes and diagonals
      auto code = way;
      for (int d = 0; d < D; ++d, code /= 3) step[d] = R(int((code + 1) % 3) - 1);
      step *= H / std::sqrt(R(step.squaredNorm()));
      for (int d = 0; d < D; ++d) {
        const double u = random.uniform(10 + d), k = std::floor(World::faces * (D == 1 ? u * u : u)) + 2;
        x[d] = nearby(corner[d] + R(k) * face, random.bits(20 + d));
        place(n, d, x[d]);
        place(n + pairs, d, nearby(x[d] + step[d], random.bits(30 + d)));
      }
      set(n, particle_kind::fluid);
      set(n + pairs, n < pairs / 4 * 3 ? particle_kind::fluid : particle_kind::boundary);
    }
  }
  void place(std::size_t i, int d, R x) { s.particles.x[d][i] = x; }
  void set(std::size_t i, particle_kind kind) {
    for (auto& v : s.particles.v) v[i] = 0;
    s.particles.rho[i] = 1000;
    s.particles.m[i] = 1;
    s.particles.kind[i] = kind;
  }
  point position(std::size_t i) const {
    point x;
    for (int d = 0; d < D; ++d) x[d] = R(s.particles.x[d][i]);
    return x;
  }
  expectation search() const {
    return registry::instance().make_reference(s.world)->cell_search(s.particles, some_threads());
  }
};
TYPED_TEST_SUITE(cell_faces_test, worlds);

TYPED_TEST(cell_faces_test, no_pair_is_missed_or_summed_twice) {
  const expectation expected = this->search();
  EXPECT_GE(expected.pairs_fluid_fluid + expected.pairs_fluid_boundary, 2 * this->s.particles.size());
  this->RecordProperty("pairs", std::to_string(expected.pairs_fluid_fluid + expected.pairs_fluid_boundary));
  int summed = 0;
  const auto sum_on = [&](const char* backend, const grid_choice& grid) {
    SCOPED_TRACE(testing::PrintToString(grid));
    const auto built = backend_names();
    if (std::ranges::find(built, backend) == built.end()) return;
    ++summed;
    const auto sum = evaluated(with(this->s.world, backend, grid, "count"), this->s.particles, 2);
    rate_table rates = sum->rates();
    EXPECT_EQ(disagreement(rates, expected), "") << backend;
    const work_counts work = sum->count_work();
    EXPECT_EQ(work.pairs_fluid_fluid, expected.pairs_fluid_fluid) << backend;
    EXPECT_EQ(work.pairs_fluid_boundary, expected.pairs_fluid_boundary) << backend;
    EXPECT_LT(work.pairs_tested, 100 * this->s.particles.size()) << "cells fold onto each other";
    rates.columns[1][this->pairs / 2] += 1;
    EXPECT_NE(disagreement(rates, expected), "") << "a wrong neighbour";
  };
  for (const char* backend : {"naive", "sphysics_sweep", "symmetric"}) sum_on(backend, TypeParam::M);
  for (const grid_choice& grid : grids_without_M()) sum_on("symmetric", grid);
  EXPECT_GT(summed, 0);
}

/// The particles are sharp enough: cells of width H exactly put some interacting partners two cells apart.
TYPED_TEST(cell_faces_test, cells_of_width_H_would_miss_pairs) {
  using R = typename TypeParam::R;
  int interacting = 0, at_H = 0, missed = 0, missed_by_inverse = 0;
  for (std::size_t n = 0; n < this->pairs; ++n) {
    const auto a = this->position(n), b = this->position(n + this->pairs);
    const R r2 = norm2<TypeParam::D, R>(a - b), reach2 = this->H * this->H;
    at_H += r2 == reach2;
    if (!(r2 < reach2)) continue;
    ++interacting;
    const auto apart = [&](auto&& cell) {
      bool two = false;
      for (int d = 0; d < TypeParam::D; ++d)
        two |= std::abs(std::floor(cell(a[d] - this->corner[d])) - std::floor(cell(b[d] - this->corner[d]))) > 1;
      return two;
    };
    missed += apart([&](R y) { return y / this->H; });
    missed_by_inverse += apart([&](R y) { return y * (1 / this->H); });
  }
  EXPECT_GT(missed, 0);
  EXPECT_GT(missed_by_inverse, 0);
  EXPECT_GT(at_H, 0) << "partners at H exactly";
  EXPECT_GT(interacting, static_cast<int>(this->pairs / 4));
  EXPECT_LT(interacting, static_cast<int>(this->pairs / 4 * 3)) << "partners on both sides of H";
  this->RecordProperty("missed", missed);
  this->RecordProperty("missed_by_inverse", missed_by_inverse);
  this->RecordProperty("at_H", at_H);
}

}  // namespace
}  // namespace pairsum

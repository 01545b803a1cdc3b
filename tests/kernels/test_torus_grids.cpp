#include <gtest/gtest.h>

#include <map>

#include <pairsum/grid/indexer.hpp>
#include "periodic_box.hpp"

// The cells of periodic boxes: where they are, and who is whose neighbour.
namespace pairsum {
namespace {

using namespace test_kit;

struct torus_world {
  grid_choice grid;
  std::vector<double> edges;  ///< in units of H
  double corner;
  axes periodic = axes::all(3);
};
std::ostream& operator<<(std::ostream& o, const torus_world& w) {
  return o << w.grid << " " << w.edges[0] << " x " << w.edges[1] << " x " << w.edges[2] << " " << w.periodic.text();
}

class torus_grids_test : public testing::TestWithParam<torus_world> {};
INSTANTIATE_TEST_SUITE_P(world, torus_grids_test,
                         testing::Values(torus_world{2, {4, 4, 4}, 0}, torus_world{2, {5.5, 9, 12.5}, -3},
                                         torus_world{3, {8, 17, 25}, 0}, torus_world{{"dense_grid", 0}, {4, 4, 4}, 0},
                                         torus_world{{"dense_grid", 0}, {5.5, 9, 14.5}, -3},
                                         torus_world{{"compact_grid", 0}, {4, 4, 4}, 0},
                                         torus_world{{"compact_grid", 0}, {5.5, 9, 14.5}, -3},
                                         // more than 2^30 cells: keys are ranks
                                         torus_world{{"compact_grid", 0}, {4001, 3000, 5000}, 1},
                                         torus_world{{"compact_grid", 0}, {4001, 3000, 5000}, 1, along_xz},
                                         torus_world{{"compact_grid", 0}, {4001, 3000, 3.5}, 1, along_yz},
                                         torus_world{2, {5.5, 9, 12.5}, -3, along_xz},
                                         torus_world{3, {8, 9, 25}, 0, along_x},
                                         torus_world{{"dense_grid", 0}, {3, 3, 3}, 0},
                                         torus_world{{"dense_grid", 0}, {5.5, 9, 14.5}, -3, along_xz},
                                         torus_world{{"dense_grid", 0}, {5.5, 3.7, 14.5}, 2, along_y},
                                         torus_world{{"compact_grid", 0}, {3.5, 9, 14.5}, -3, along_x},
                                         torus_world{{"compact_grid", 0}, {3.5, 3, 14.5}, 0}));

TEST_P(torus_grids_test, close_on_themselves) {
  const torus_world& w = GetParam();
  constexpr double H = 0.5;
  setup s;
  s.periodic = w.periodic;
  s.grid = w.grid.name;
  s.M = w.grid.M;
  s.constants.H = H;
  for (const double e : w.edges) s.omega_low.push_back(w.corner), s.omega_high.push_back(w.corner + e * H);
  const box<3, double> omega = make_box<3, double>(s);
  particle_set<3, double> p;
  constexpr std::size_t n = 3000;
  p.resize(n);
  const counter_random random(3);
  for (std::size_t i = 0; i < n; ++i) {
    for (unsigned d = 0; d < 3; ++d) {
      // Within 3 H of a corner, so that cells have neighbours in every world, some on the faces.
      double u = std::floor(random.uniform(8 * i + d, -3, 3) * 4) / 4 * H;
      if (u < 0) u += w.edges[d] * H;
      p.x[d][i] = std::min(w.corner + u, omega.high[d]);
      p.v[d][i] = 0;
    }
    p.rho[i] = p.m[i] = 1;
    p.id[i] = static_cast<std::uint32_t>(i);
    p.kind[i] = i % 5 == 0 ? particle_kind::boundary : particle_kind::fluid;
  }
  indexer<3, double> index(omega, make_grid<3, double>(s));
  for (const int threads : {1, 3}) {
    workers all(runtime::omp, threads);
    index.forget();
    index.build(p, all.get());
    const cells<3>& c = index.view();
    const std::int64_t multiple = w.grid.M > 0 ? 1 << w.grid.M : 2;
    const ivec<3> whole = torus_cells(omega, H, multiple);
    std::map<ivec<3>, std::size_t> at;  // of the cells with fluid
    for (int d = 0; d < 3; ++d) {
      EXPECT_TRUE(c.period[d] % 2 == 0 || c.period[d] == 3);
      EXPECT_EQ(c.period[d], w.grid.M > 0 ? multiple : whole[d]);
      EXPECT_EQ(whole[d] > 0, w.periodic[d]);
      if (w.periodic[d]) EXPECT_GE(omega.edge(d) / static_cast<double>(whole[d]), H);
    }
    const auto cell_of = [&](std::size_t i) {
      ivec<3> a;
      for (int d = 0; d < 3; ++d) {
        const double width = whole[d] > 0 ? omega.edge(d) / static_cast<double>(whole[d]) : safe_width(omega, H);
        a[d] = static_cast<std::int64_t>((p.x[d][i] - omega.low[d]) * (1 / width));
        if (whole[d] > 0) a[d] %= whole[d];
        if (c.period[d] > 0) a[d] %= c.period[d];
      }
      return a;
    };
    for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell) at[c.place[cell]] = cell;
    EXPECT_EQ(at.size(), c.fluid_cells);
    std::map<ivec<3>, std::size_t> boundary;  // particles
    std::size_t fluid = 0;
    for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
      for (auto i = c.range[cell].fluid.begin; i < c.range[cell].fluid.end; ++i, ++fluid)
        ASSERT_EQ(cell_of(i), c.place[cell]);
    EXPECT_EQ(fluid, n - n / 5);
    for (std::size_t i = fluid; i < n; ++i) ++boundary[cell_of(i)];
    std::size_t through = 0;
    for (std::size_t cell = 1; cell <= c.fluid_cells; ++cell)
      for (unsigned code = 0; code < cells<3>::stencil; ++code) {
        const auto step = pattern::neighbour_offset<3>(code);
        ivec<3> to;
        for (int d = 0; d < 3; ++d) {
          const std::int64_t a = c.place[cell][d] + step[d];
          to[d] = c.period[d] > 0 ? (a + c.period[d]) % c.period[d] : a;
          through += a != to[d];
        }
        const std::uint32_t other = c.neighbour(cell, code);
        const auto known = at.find(to);
        if (known != at.end()) {
          ASSERT_EQ(other, known->second);
        } else {
          ASSERT_TRUE(other == 0 || other > c.fluid_cells);
        }
        const auto walls = boundary.find(to);
        ASSERT_EQ(c.range[other].boundary.size(), walls == boundary.end() ? 0 : walls->second);
      }
    EXPECT_GT(through, 100u);
  }
}

TEST(torus_grids, dense_grid_refuses_more_cells_than_it_can_number) {
  setup s;
  s.dim = 3;
  s.periodic = axes::all(3);
  s.grid = "dense_grid";
  s.constants.H = 1;
  s.omega_low.assign(3, 0);
  s.omega_high.assign(3, 2000);
  const box<3, double> omega = make_box<3, double>(s);
  particle_set<3, double> none;
  indexer<3, double> index(omega, make_grid<3, double>(s));
  const auto text = error_of([&] { index.build(none, team()); });
  EXPECT_TRUE(says(text, {"dense_grid would need", "2000 x 2000 x 2000", "periodic box", "compact_grid"})) << text;
}

TEST(torus_grids, wrapped_points_lie_in_the_box) {
  const double far = std::numeric_limits<double>::infinity();
  for (const auto& [low, high] : {std::pair{0.0, 1.0}, {-0.7, 0.4}, {1e6, 1e6 + 3.3}, {-1e-3, 1e9}}) {
    const box<1, double> b{vec<1, double>(low), vec<1, double>(high), axes::all(1)};
    for (const double x : {low, std::nextafter(low, -far), high, std::nextafter(high, -far), std::nextafter(high, far),
                           low - 12.34, high + 1e5, 0.3, -1e300, 1e300}) {
      const double y = b.wrapped(0, x);
      EXPECT_TRUE(y >= low && y < high) << x << " in [" << low << ", " << high << ")";
      EXPECT_EQ(x >= low && x < high, x == y);
    }
    EXPECT_EQ(b.wrapped(0, high), low);
    EXPECT_TRUE(std::isnan(b.wrapped(0, far)));
    EXPECT_TRUE(std::isnan(b.wrapped(0, std::nan(""))));
  }
}

}  // namespace
}  // namespace pairsum

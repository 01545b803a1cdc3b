#pragma once
#include <array>
#include <cmath>

#include <pairsum/sum/grids.hpp>
#include "cloud.hpp"

// Periodic boxes, and who is in whose reach there, by expressions of the tests' own.
namespace pairsum::test_kit {

inline constexpr axes along_x{{true, false, false}}, along_y{{false, true, false}}, along_xz{{true, false, true}},
    along_yz{{false, true, true}};

/// The cloud in a box that is `stretch` times as long along each axis and periodic along some, else along all.
inline scene make_periodic(const cloud& c, const std::array<double, 3>& stretch = {1, 1, 1}, const axes& along = {}) {
  scene s = make_cloud(c);
  s.world.periodic = along.any() ? along : axes::all(c.dim);
  for (std::size_t d = 0; d < s.world.omega_low.size(); ++d) {
    double& high = s.world.omega_high[d];
    high = c.corner + c.length * c.H * stretch[d];
    for (double& x : s.particles.x[d]) x = std::min(c.corner + (x - c.corner) * stretch[d], high);
  }
  return s;
}

/// Does the setup's grid go round its box?
inline bool goes_round(const setup& s) {
  return error_of([&] { (void)registry::instance().make_summation(s); }).empty();
}

/// Every grid, the hashed one with every of these M that goes round the box for the setup's backend.
inline std::vector<grid_choice> grids_round(const setup& s, const std::vector<int>& all_M = {2, 3, 4, 5}) {
  std::vector<grid_choice> all;
  for (const grid_choice& g : every_grid(all_M))
    if (goes_round(with(s, s.backend, g, s.interaction))) all.push_back(g);
  return all;
}

/// Neighbours of each fluid particle and the sum of their ids, in precision R: r less a whole number of edges of the
/// periodic axes.
template <class R>
rate_table count_by_hand(const scene& s) {
  const particle_table& p = s.particles;
  std::vector<std::array<R, 3>> x(p.size(), std::array<R, 3>{});
  std::array<R, 3> edge{};
  for (std::size_t d = 0; d < p.x.size(); ++d) {
    const box<1, R> axis = make_box_of_axis<R>(s.world, d);
    if (s.world.periodic.on[d]) edge[d] = axis.high[0] - axis.low[0];
    for (std::size_t i = 0; i < p.size(); ++i) {
      x[i][d] = static_cast<R>(p.x[d][i]);
      if (edge[d] > 0 && x[i][d] == axis.high[0]) x[i][d] = axis.low[0];
    }
  }
  const R H = static_cast<R>(s.world.constants.H);
  rate_table table{{"neighbours", "ids"}, {std::vector<double>(p.size()), std::vector<double>(p.size())}};
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < p.size() && p.kind[i] == particle_kind::fluid; ++j) {
      if (i == j) continue;
      R r2 = 0;
      for (std::size_t d = p.x.size(); d-- > 0;) {
        R r = x[i][d] - x[j][d];
        if (edge[d] > 0) r -= edge[d] * std::round(r / edge[d]);
        r2 = d + 1 == p.x.size() ? r * r : fused(r, r, r2);
      }
      if (!(r2 < H * H)) continue;
      table.columns[0][i] += 1;
      table.columns[1][i] += static_cast<double>(j);
    }
  return table;
}

inline rate_table count_by_hand(const scene& s, const std::string& precision) {
  return precision == "float" ? count_by_hand<float>(s) : count_by_hand<double>(s);
}

/// A setup of the scene's world that counts.
inline setup counting(const scene& s, std::string_view backend, const grid_choice& grid,
                      std::string_view precision = "double") {
  setup world = with(s.world, backend, grid, "count");
  world.precision = precision;
  return world;
}

/// A box that is periodic along some axes, of edges in units of H.
struct narrow_box {
  int dim;
  axes periodic;
  std::array<double, 3> reaches;
  /// Random particles in it.
  scene make(std::uint32_t fluid, std::uint32_t boundary) const {
    cloud c;
    c.dim = dim;
    c.fluid = fluid;
    c.boundary = boundary;
    c.H = 0.125;
    c.length = 1;
    return make_periodic(c, reaches, periodic);
  }
};
inline std::ostream& operator<<(std::ostream& o, const narrow_box& b) {
  return o << b.dim << "D, periodic along " << b.periodic.text() << ", " << b.reaches[0] << " x " << b.reaches[1]
           << " x " << b.reaches[2] << " H";
}
/// Some axes open and some periodic, and axes with room for 3 cells: cubes of 3 H exactly and more, walls, pillars.
inline std::vector<narrow_box> narrow_boxes() {
  const std::vector<narrow_box> all{
      {3, along_xz, {8.5, 6, 4}},       {3, along_x, {3.5, 6, 5}},        {3, along_yz, {5, 4.2, 3}},
      {3, along_yz, {0.4, 8, 3.2}},     {3, axes::all(3), {3, 3, 3}},     {3, axes::all(3), {3.5, 3.5, 3.5}},
      {3, axes::all(3), {3.5, 9, 6.5}}, {3, axes::all(3), {8, 8, 3}},     {2, along_x, {3, 9, 0}},
      {2, along_y, {7, 8.3, 0}},        {2, axes::all(2), {3.5, 3.5, 0}}, {2, axes::all(2), {12, 3.7, 0}},
      {1, axes::all(1), {3.5, 0, 0}}};
  std::vector<narrow_box> built;
  for (const narrow_box& b : all)
    if (std::ranges::count(registry::instance().dims(), b.dim) > 0) built.push_back(b);
  return built;
}

/// `n` fluid particles at rest, the k-th at at(k), in a periodic box from 0 to edges.
template <class At>
scene placed(int dim, const std::vector<double>& edges, double H, std::size_t n, At&& at) {
  scene s;
  s.world.dim = dim;
  s.world.constants.H = H;
  s.world.omega_low.assign(static_cast<std::size_t>(dim), 0);
  s.world.omega_high.assign(edges.begin(), edges.begin() + dim);
  s.world.periodic = axes::all(dim);
  particle_table& p = s.particles = particle_table(dim);
  p.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::array<double, 3> x = at(i);
    for (int d = 0; d < dim; ++d) p.x[d][i] = x[static_cast<std::size_t>(d)], p.v[d][i] = 0;
    p.rho[i] = 1000;
    p.m[i] = 1;
    p.kind[i] = particle_kind::fluid;
  }
  return s;
}

}  // namespace pairsum::test_kit

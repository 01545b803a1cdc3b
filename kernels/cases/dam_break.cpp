#include <cmath>

#include <pairsum/cases/case.hpp>
#include <pairsum/core/error.hpp>
#include <pairsum/core/memory.hpp>
#include <pairsum/core/names.hpp>

namespace pairsum {

/// The talk's dam break (Willkomm 2009, slide "test case"; Ferrari et al. 2009): a cube of water of about 0.6 m in a
/// corner of an open tank of 3.25 x 1.8 x 0.6 m, y up. Water: (round((0.6 - 2 dx)/dx) + 1)^3 points from dx to 0.6 -
/// dx, at rest, hydrostatic. Boundary: plates of spacing dx/1.5, shared edges kept twice. In 2D the z axis is dropped:
/// two walls and the floor.
struct dam_break {
  static constexpr std::string_view name = "dam_break";
  static constexpr std::string_view description =
      "water cube collapsing in an open tank (Willkomm 2009, Ferrari et al. 2009); 2D and 3D";

  static constexpr int least_dim = 2;
  static constexpr double water = 0.6, tank_length = 3.25, tank_height = 1.8, tank_width = 0.6;

  static initial_condition make(const case_parameters& c) {
    if (c.dim != 2 && c.dim != 3) throw error("dam_break exists in 2D and 3D, not in " + std::to_string(c.dim) + "D");
    const double dx = c.dx, edge = water - 2 * dx;
    const double per_axis = std::round(edge / dx) + 1;
    if (!(per_axis >= 3)) throw error("dam_break needs dx <= 0.17 m (three particles an axis), is " + number_text(dx));
    const double plate = dx / 1.5;
    const double estimate = std::pow(per_axis, c.dim) + (c.dim == 3 ? 16 / (plate * plate) : 7 / plate);
    if (estimate > 4e9) throw error("dam_break with dx = " + number_text(dx) + " has more than 2^32 particles");
    check_memory(estimate * bytes_per_particle, "dam_break with dx = " + number_text(dx), "a larger dx takes less");
    initial_condition made;
    made.particles = particle_table(c.dim);
    made.omega_low.assign(c.dim, 0.0);
    made.omega_high = {3.3, 1.8};
    if (c.dim == 3) made.omega_high.push_back(0.61);
    add_water(made, static_cast<std::size_t>(per_axis), dx, edge);
    add_tank(made, plate);
    return made;
  }

 private:
  static void add(initial_condition& c, particle_kind kind, const std::array<double, 3>& x, double rho, double m) {
    particle_table& p = c.particles;
    for (int d = 0; d < p.dim; ++d) {
      p.x[d].push_back(x[d]);
      p.v[d].push_back(0);
    }
    p.rho.push_back(rho);
    p.m.push_back(m);
    p.kind.push_back(kind);
  }

  static void add_water(initial_condition& c, std::size_t n, double dx, double edge) {
    const int dim = c.particles.dim;
    const double step = edge / static_cast<double>(n - 1);
    const double count = std::pow(static_cast<double>(n), dim);
    const double m = c.eos.rho0 * std::pow(edge, dim) / count;
    const auto at = [&](std::size_t k) { return k + 1 == n ? water - dx : dx + step * static_cast<double>(k); };
    for (std::size_t z = 0; z < (dim == 3 ? n : 1); ++z)
      for (std::size_t y = 0; y < n; ++y) {
        const double rho = c.eos.density_at(water - dx - at(y), c.gravity);
        for (std::size_t x = 0; x < n; ++x) add(c, particle_kind::fluid, {at(x), at(y), at(z)}, rho, m);
      }
  }

  /// round(length/spacing) + 1 points from 0 to length, both ends included.
  static std::vector<double> spread(double length, double spacing) {
    const auto n = static_cast<std::size_t>(std::round(length / spacing)) + 1;
    std::vector<double> at(n);
    for (std::size_t k = 0; k < n; ++k)
      at[k] = k + 1 == n ? length : length * static_cast<double>(k) / static_cast<double>(n - 1);
    return at;
  }

  static void add_tank(initial_condition& c, double spacing) {
    const int dim = c.particles.dim;
    const double m = c.particles.m.front();
    const auto x = spread(tank_length, spacing), y = spread(tank_height, spacing), z = spread(tank_width, spacing);
    const auto wall = [&](double px, double py, double pz) {
      add(c, particle_kind::boundary, {px, py, pz}, c.eos.rho0, m);
    };
    if (dim == 2) {
      for (const double side : {0.0, tank_length})
        for (const double py : y) wall(side, py, 0);
      for (const double px : x) wall(px, 0, 0);
      return;
    }
    for (const double side : {0.0, tank_width})
      for (const double px : x)
        for (const double py : y) wall(px, py, side);
    for (const double side : {0.0, tank_length})
      for (const double pz : z)
        for (const double py : y) wall(side, py, pz);
    for (const double px : x)
      for (const double pz : z) wall(px, 0, pz);
  }
};

}  // namespace pairsum

PAIRSUM_CASE(dam_break)

#include <pairsum/cases/random_points.hpp>

namespace pairsum {

/// Fluid in clusters of about 1000 particles: cubes with 8 times the mean density, placed uniformly at random in the
/// unit cube (they may overlap), empty space between them. Cells differ widely in what they hold, which is what tells
/// schedules apart.
struct random_clustered {
  static constexpr std::string_view name = "random_clustered";
  static constexpr std::string_view description =
      "fluid in random clusters of 8 times the mean density, no boundary; 1D, 2D and 3D";
  static constexpr double particles_of_cluster = 1000, density_of_cluster = 8;

  static initial_condition make(const case_parameters& c) {
    const counter_random random(c.seed, 6), centers(c.seed, 7);
    return random_points(name, c, [&](std::size_t i, std::size_t n) {
      const double clusters = std::max(1.0, std::round(static_cast<double>(n) / particles_of_cluster));
      const double edge = std::pow(density_of_cluster * clusters, -1.0 / c.dim);
      const auto cluster = i % static_cast<std::size_t>(clusters);
      std::array<double, 3> x{};
      for (std::size_t d = 0; d < 3; ++d)
        x[d] = centers.uniform(3 * cluster + d) * (1 - edge) + edge * random.uniform(3 * i + d);
      return x;
    });
  }
};

}  // namespace pairsum

PAIRSUM_CASE(random_clustered)

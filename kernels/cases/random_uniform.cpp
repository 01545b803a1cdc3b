#include <pairsum/cases/random_points.hpp>

namespace pairsum {

/// Fluid placed independently and uniformly in the unit cube: the number of neighbours varies from particle to particle
/// like that of a Poisson process.
struct random_uniform {
  static constexpr std::string_view name = "random_uniform";
  static constexpr std::string_view description =
      "fluid placed uniformly at random in the unit cube, no boundary; 1D, 2D and 3D";

  static initial_condition make(const case_parameters& c) {
    const counter_random random(c.seed, 6);
    return random_points(name, c, [&](std::size_t i, std::size_t) {
      return std::array{random.uniform(3 * i), random.uniform(3 * i + 1), random.uniform(3 * i + 2)};
    });
  }
};

}  // namespace pairsum

PAIRSUM_CASE(random_uniform)

#include <pairsum/cases/unit_cube.hpp>

namespace pairsum {

/// Fluid at rest on a cubic lattice that fills the unit cube: round(1/dx)^dim particles at the centres of cells of
/// width 1/round(1/dx); no boundary. The perturbed state is the jittered lattice that SPH codes are usually timed on.
struct lattice {
  static constexpr std::string_view name = "lattice";
  static constexpr std::string_view description =
      "fluid on a cubic lattice in the unit cube, no boundary; 1D, 2D and 3D";

  static initial_condition make(const case_parameters& c) { return unit_lattice(name, c); }
};

}  // namespace pairsum

PAIRSUM_CASE(lattice)

#include <pairsum/cases/unit_cube.hpp>

namespace pairsum {

/// The lattice in a periodic unit cube: no particle lies at the rim, all have as many neighbours. With the default H =
/// 2 dx and dx = 2^-k the box is 2^(k-1) H, as the hashed grid with M = k - 1 is.
struct periodic_lattice {
  static constexpr std::string_view name = "periodic_lattice";
  static constexpr std::string_view description =
      "fluid on a cubic lattice in the unit cube, periodic along every axis, no boundary; 1D, 2D and 3D";

  static initial_condition make(const case_parameters& c) {
    const double H = c.H != 0 ? c.H : 2 * c.dx;
    if (!(3 * H <= 1))
      throw error(std::string(name) + " is 1 m wide and periodic, for which H may be up to 1/3 m, is " +
                  number_text(H));
    initial_condition made = unit_lattice(name, c);
    made.periodic = axes::all(c.dim);
    return made;
  }
};

}  // namespace pairsum

PAIRSUM_CASE(periodic_lattice)

#pragma once
#include <span>
#include <string_view>

namespace pairsum::files {

/// Which of its groups' particles a file means.
enum class groups_meant {
  all,    ///< each holds one kind, which its name says
  first,  ///< that with number 0; others hold what is no fluid, unless options name them
  last,   ///< each is a step
};

/// The names that one program gives to what an HDF5 file of particles holds. Alternatives are separated by '|', the
/// first that is there counts; upper and lower case are the same. "x,y,z" are datasets of a column each; one name
/// alone is a dataset with as many columns as dimensions. GROUP@NAME is an attribute, of the group with the particles
/// if it begins with '@'.
struct hdf5_dialect {
  std::string_view name;
  std::string_view groups;  ///< groups with particles; * stands for any letters
  groups_meant meant = groups_meant::all;
  std::string_view marks = "";                ///< one of these must be there; empty: nothing must
  std::string_view x = "", v = "";            ///< positions, velocities
  std::string_view rho = "", m = "", h = "";  ///< density, mass, smoothing length
  std::string_view kind = "";                 ///< a column: 0 fluid, 1 boundary
  std::string_view time = "", dim = "";       ///< attributes
  std::string_view edges = "";                ///< of a box at 0: one number for all axes, or one for each
  std::string_view limits = "";               ///< of a box: low and high of x, of y and of z
  std::string_view low = "", high = "";       ///< of a box, a number per axis
  std::string_view axes = "";       ///< periodic or not: one number for all axes, or one for each; 1 is periodic
  std::string_view gamma = "";      ///< support radius over smoothing length
  std::string_view length_is = "";  ///< a text: what h is, "h" or "support"
  std::string_view function = "";   ///< the smoothing kernel's name, which says gamma where no attribute does
  std::string_view masses =
      "";  ///< an attribute: the mass of all particles of a group, by its number; 0 means a column
  std::string_view counts = "";  ///< an attribute: how many particles a group has, by its number
  std::string_view files = "";   ///< an attribute: how many files hold the particles, NAME.0.hdf5, NAME.1.hdf5, ...
  std::string_view rho0 = "", B = "", H = "", gravity = "",
                   dx = "";  ///< reference density, stiffness, support radius, gravity, spacing: attributes
  double support = 2;        ///< support radius over smoothing length, unless the file says it
  bool periodic = false;     ///< along every axis with a box, unless the file says it
};

/// All dialects; the first whose groups and marks a file has is its own.
std::span<const hdf5_dialect> hdf5_dialects();

/// Support radius over smoothing length of a smoothing kernel, as SWIFT names it, in 1D, 2D or 3D; 0 if unknown.
/// Source: Dehnen and Aly 2012 (doi:10.1111/j.1365-2966.2012.21439.x), table 1.
double gamma_of(std::string_view function, int dim);

/// What the name of a group of particles says of their kind.
enum class kind_word { none, fluid, boundary, body };

/// By the words of a name, between digits, signs and capitals; those for fluid come first: "fluid_box" is fluid,
/// "wall_2" and "TankWall" boundary, "rigid_body" a body that moves, "sandbox" none of them.
kind_word kind_named(std::string_view group);

}  // namespace pairsum::files

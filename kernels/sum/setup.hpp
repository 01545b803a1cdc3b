#pragma once
#include <string>
#include <vector>

#include <pairsum/core/axes.hpp>
#include <pairsum/interactions/interaction.hpp>

namespace pairsum {

/// Names one summation, in the words of the command line, and its domain.
struct setup {
  std::string backend = "symmetric";
  std::string interaction = "ferrari09";
  std::string smoothing = "wendland_c2";
  std::string precision = "double";
  std::string grid = "hashed_grid";
  int dim = 3;
  int M = 7;  ///< for grids that take one
  /// Instruction set of vector units: a word of isa_names(), `best` of them, `scalar` for none, or the backend's
  /// `default`.
  std::string isa = "default";
  std::string block = "auto";  ///< blocks of backends that have them: slab:N, pencil:N, brick:N (N cells wide), or auto
  std::size_t cache_bytes = 0;  ///< of a core, for `auto` blocks; 0: 1 MiB
  std::size_t cores = 0;  ///< that a process may use, however many it takes, for `auto` blocks; 0: as the machine says
  std::vector<double> omega_low, omega_high;  ///< m, `dim` values each
  axes periodic = {};  ///< what leaves through their faces comes back at the opposite one, and pairs reach through them
  physics constants;   ///< H, the equation of state, the spacing
};

}  // namespace pairsum

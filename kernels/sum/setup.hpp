#pragma once
#include <string>
#include <vector>

#include "interactions/interaction.hpp"

namespace pairsum {

/// Names one summation, in the words of the command line, and the world it happens in.
struct setup {
  std::string backend = "symmetric";
  std::string interaction = "ferrari09";
  std::string smoothing = "wendland_c2";
  std::string precision = "double";
  std::string grid = "hashed_grid";
  int dim = 3;
  int M = 7;
  std::vector<double> omega_low, omega_high;  ///< m, `dim` values each
  physics constants;                          ///< H and the equation of state
};

}  // namespace pairsum

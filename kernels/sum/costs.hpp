#pragma once
#include <optional>

#include <pairsum/interactions/interaction.hpp>

namespace pairsum {

/// What one interaction, with its smoothing kernel, dimension and precision, costs by the piece: the material of a
/// lower bound for the time of a summation.
struct formula_costs {
  int dim = 0;
  int distance_test = 0;               ///< flops of x_i - x_j, its square and the comparison
  pair_flops counted;                  ///< flops of a pair, counted by running the formula
  std::optional<pair_flops> declared;  ///< what the interaction says of itself, if it does
  double boundary_reach = 0;           ///< of H; 0 if boundary particles do not act
  int fluid_bytes = 0;                 ///< place and columns of a fluid particle
  int boundary_bytes = 0;              ///< the same of a boundary particle
  int rates_bytes = 0;                 ///< the rates of a fluid particle
};

}  // namespace pairsum

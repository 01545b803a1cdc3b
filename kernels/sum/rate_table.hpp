#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace pairsum {

/// Rates of all fluid particles, a column per scalar ("drho", "dv_x", ...), rows in id order; SI units. Integers up to
/// 2^53 are exact. Rows of ids that are not fluid (any more) are 0.
struct rate_table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
};

/// What a reference says of some particles: rates, and how far a correct backend may be from them.
struct expectation {
  std::vector<std::string> names;
  std::vector<std::uint32_t> ids;              ///< the fluid particles that were evaluated
  std::vector<std::vector<double>> value;      ///< [column][k]: rate of ids[k]
  std::vector<std::vector<double>> bound;      ///< largest |rate - value| that rounding can explain
  std::vector<std::vector<double>> magnitude;  ///< sum of the absolute values of the terms
  std::uint64_t pairs_fluid_fluid = 0;         ///< over the evaluated particles: each pair once if all were evaluated
  std::uint64_t pairs_fluid_boundary = 0;
};

}  // namespace pairsum

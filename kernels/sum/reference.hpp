#pragma once
#include <memory>
#include <vector>

#include <pairsum/particles/particle_table.hpp>
#include <pairsum/sum/costs.hpp>
#include <pairsum/sum/rate_table.hpp>

namespace pairsum {

/// The oracle: sums the same formula without any of the library's grids, sorts or loops, and gives an error bound
/// within which a correct backend must agree with it.
class reference {
 public:
  virtual ~reference() = default;

  /// The given fluid particles against every other particle: O(ids * N). Empty `ids` means all.
  virtual expectation brute_force(const particle_table& p, const team& t,
                                  std::vector<std::uint32_t> ids = {}) const = 0;

  /// All fluid particles by a cell search of its own (sorted cell numbers, cells 1 % wider than H): O(N log N).
  virtual expectation cell_search(const particle_table& p, const team& t) const = 0;

  /// What the formula costs by the piece.
  virtual formula_costs costs() const = 0;
};

}  // namespace pairsum

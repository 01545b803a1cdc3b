#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace pairsum {

/// Work of one summation, counted in a run of its own on one thread, never in the timed one.
struct work_counts {
  std::uint64_t cells = 0, cells_nonempty = 0;
  std::uint64_t sumF1 = 0, sumF2 = 0;   ///< cells and cell pairs visited (those with fluid); 0 for the gather
  std::uint64_t pairs_tested = 0;       ///< distance tests made
  std::uint64_t pairs_fluid_fluid = 0;  ///< interacting pairs, each once
  std::uint64_t pairs_fluid_boundary = 0;
  std::uint64_t pairs_cut = 0;        ///< of the fluid pairs those with a ghost
  std::uint64_t pairs_evaluated = 0;  ///< times the formula was evaluated
  /// Vectors that the fluid pairs of each particle i fill, the last one in part, for 2, 4, 8, 16 lanes.
  std::array<std::uint64_t, 4> vectors{};

  std::uint64_t pairs_interacting() const { return pairs_fluid_fluid + pairs_fluid_boundary; }
  std::uint64_t vectors_of(std::size_t lanes) const {
    for (std::size_t k = 0; k < vectors.size(); ++k)
      if (std::size_t{2} << k == lanes) return vectors[k];
    return fluid_evaluated();
  }
  /// Times the formula was evaluated for two fluid particles.
  std::uint64_t fluid_evaluated() const { return pairs_evaluated - pairs_fluid_boundary; }

  /// Takes the evaluated partners of one particle.
  void evaluated(std::uint64_t fluid, std::uint64_t boundary) {
    pairs_evaluated += fluid + boundary;
    for (std::size_t k = 0; k < vectors.size(); ++k) vectors[k] += (fluid + (2u << k) - 1) >> (k + 1);
  }
};

/// Distance tests on a grid without folded cells: by the gather (each fluid pair twice) and by symmetric sums.
struct unfolded_tests {
  std::uint64_t gather = 0, symmetric = 0;
};

}  // namespace pairsum

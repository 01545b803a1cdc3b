#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/pass_observer.hpp"

namespace pairsum {

/// Work of one summation, counted in an instantiation of its own, never in the timed one.
struct work_counts {
  std::uint64_t cells = 0, cells_nonempty = 0;
  std::uint64_t sumF1 = 0, sumF2 = 0;   ///< cells and cell pairs visited (those with fluid); 0 for the gather
  std::uint64_t pairs_tested = 0;       ///< distance tests made
  std::uint64_t pairs_fluid_fluid = 0;  ///< interacting pairs, each once
  std::uint64_t pairs_fluid_boundary = 0;
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
};

/// Distance tests on a grid without folded cells: by the gather (each fluid pair twice) and by symmetric sums.
struct unfolded_tests {
  std::uint64_t gather = 0, symmetric = 0;
};

/// The timed instantiation counts nothing; it marks passes for whoever observes them.
struct no_probe : pass_marks {
  static constexpr bool counting = false;
  void sumF1(std::uint64_t) {}
  void sumF2(std::uint64_t) {}
  void tested(std::uint64_t) {}
  void fluid_pairs(std::uint64_t) {}
  void boundary_pairs(std::uint64_t) {}
  void evaluated(std::uint64_t) {}
  void pairs_of_one(std::uint64_t) {}
};

/// Counts; for one thread, unobserved.
struct work_probe : pass_marks {
  static constexpr bool counting = true;
  work_counts counts;
  void sumF1(std::uint64_t n) { counts.sumF1 += n; }
  void sumF2(std::uint64_t n) { counts.sumF2 += n; }
  void tested(std::uint64_t n) { counts.pairs_tested += n; }
  void fluid_pairs(std::uint64_t n) { counts.pairs_fluid_fluid += n; }
  void boundary_pairs(std::uint64_t n) { counts.pairs_fluid_boundary += n; }
  void evaluated(std::uint64_t n) { counts.pairs_evaluated += n; }
  void pairs_of_one(std::uint64_t n) {
    for (std::size_t k = 0; k < counts.vectors.size(); ++k) counts.vectors[k] += (n + (2u << k) - 1) >> (k + 1);
  }
};

}  // namespace pairsum

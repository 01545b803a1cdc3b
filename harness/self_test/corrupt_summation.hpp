#pragma once
#include <cmath>

#include "harness/self_test/forwarding_summation.hpp"

namespace pairsum::harness {

/// One rate of one particle is wrong in every result: the largest of all is doubled (1 where all are 0), which no
/// rounding explains. An integrator moves the particles by the right rates.
class corrupt_summation final : public forwarding_summation {
 public:
  using forwarding_summation::forwarding_summation;

  rate_table rates() const override {
    rate_table table = forwarding_summation::rates();
    const particle_table particles = snapshot();
    double* largest = nullptr;
    for (std::vector<double>& column : table.columns)
      for (std::size_t id = 0; id < column.size(); ++id) {
        if (particles.kind[id] != particle_kind::fluid) continue;
        if (largest == nullptr || std::abs(column[id]) > std::abs(*largest)) largest = &column[id];
      }
    if (largest != nullptr) *largest = *largest == 0 ? 1 : 2 * *largest;
    return table;
  }

  /// Never that of the right rates.
  std::uint64_t fingerprint() const override { return ~forwarding_summation::fingerprint(); }
};

}  // namespace pairsum::harness

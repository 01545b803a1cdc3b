#pragma once
#include <array>

#include "sum/summation.hpp"

namespace pairsum {

/// A summation whose particles are known to be D-dimensional in precision R: what integrators and backends' adapters
/// work on.
template <int D, class R>
class state : public summation {
 public:
  /// Columns of the rates an integrator uses, in the order of the particles; empty if the interaction has none.
  struct dynamics {
    const R* drho = nullptr;
    std::array<const R*, D> dv{};
    explicit operator bool() const { return drho != nullptr; }
  };
  virtual dynamics rates_of_state() = 0;

  particle_set<D, R>& particles() { return particles_; }
  /// Fluid particles are the first of the set after index().
  virtual std::size_t fluid_count() const = 0;

 protected:
  particle_set<D, R> particles_;
};

}  // namespace pairsum

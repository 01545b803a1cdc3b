#pragma once
#include <cstdint>
#include <span>

#include <pairsum/eos/tait.hpp>
#include <pairsum/sum/summation.hpp>

namespace pairsum::harness {

/// The largest of the fluid after a step, and whom they belong to.
struct extremes {
  double speed = 0;           ///< m/s
  double acceleration = 0;    ///< m/s2, gravity included, at the state that was evaluated last
  double density = 0;         ///< kg/m3
  std::uint32_t fastest = 0;  ///< the id of the particle with that speed
  bool finite = true;         ///< positions, velocities, densities; else see summation::not_finite()
};

/// @param gravity m/s2, along -y (along -x in 1D)
extremes extremes_of(summation& s, double gravity, const team& t);

/// The largest of all; of equally fast ones the first.
extremes largest_of(std::span<const extremes> all);

/// The time step that the fastest particle, sound and the strongest acceleration allow (Monaghan, Annu. Rev. Astron.
/// Astrophys. 30 (1992) 543, sec. 10), s: cfl min(h / (c + |v|), sqrt(h / |a|)), h = H/2.
double time_step(const extremes& e, double H, const tait& eos, double cfl);

}  // namespace pairsum::harness

#pragma once
#include <string>

#include "contender.hpp"

namespace pairsum::races {

/// Particles, a grid and a number of Euler steps.
struct trial {
  std::string case_name;
  double dx;  ///< m
  int M;
  int steps;
};

/// Enough fluid (104 thousand particles in dam_break) that threads meet: with a few thousand, real races
/// stay unseen. M = 5 folds the tank's boundary onto the fluid, M = 4 the fluid onto itself. M = 2,
/// the smallest torus, tests a fifth of all N^2 pairs and so has to do with fewer particles.
inline const std::vector<trial> all_trials{
    {"dam_break", 0.0126, 5, 2}, {"dam_break", 0.0126, 4, 2}, {"lattice", 0.037, 2, 2}};

/// The trial for the planted races, which are reported in its first step.
inline const std::vector<trial> planted_trials{all_trials.front()};

/// Runs one trial on `threads` OpenMP threads: every phase in parallel, particles in random order
/// at first, and steps so long that they change cells and some leave Omega. Names each phase on
/// stderr when it begins, so that a report can be told where it belongs.
void run(const contender& c, const trial& w, int threads);

}  // namespace pairsum::races

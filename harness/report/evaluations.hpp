#pragma once

#include <map>
#include <optional>

#include "harness/report/measured.hpp"
#include "harness/stats/ratio.hpp"

namespace pairsum::harness {

/// Values of a point by round.
using round_values = std::map<round_key, double>;

/// What it took to get the rates in each round: prepare, zero, sum and reduce together. The sum alone would flatter
/// those who make lists before it or join copies behind it. Empty if one of them was not timed in every round.
round_values evaluations_of(const measured_point& p);

/// The median over the rounds; there must be some.
double median_of(const round_values& values);

/// Base over other, paired in the rounds that both have; unpaired if there are none.
ratio_estimate ratio_of(const round_values& base, const round_values& other);

/// The value over that of `base` in each round that both have.
round_values standing(const round_values& values, const round_values& base);

/// Base over other of what was measured in different rounds.
ratio_estimate unpaired_ratio_of(const round_values& base, const round_values& other);

}  // namespace pairsum::harness

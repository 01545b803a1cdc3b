#pragma once
#include <cstdint>

namespace pairsum::pattern {

/// Colours along one axis of cells such that two of the same colour are at least `spacing` apart: 0 1 2 0 1 2 ... for a
/// spacing of 3. On an axis that closes on itself after `period` cells (0: it does not) the pattern must fit around. If
/// the spacing does not divide the period, as 3 does not divide 2^M, it starts with runs that are one colour longer,
/// the seam, as many as the remainder:
///
///     period 8, spacing 3:   0 1 2 3  0 1 2 3        period 16:   0 1 2 3  0 1 2  0 1 2  0 1 2  0 1 2
///
/// A colour then comes again after one run, `spacing` or `spacing + 1` cells on, also across the end. A period too
/// short for that has a colour for each cell.
constexpr unsigned axis_colour(std::int64_t position, std::int64_t period, std::int64_t spacing) {
  const std::int64_t longer = period % spacing, seam = longer * (spacing + 1);
  if (period < seam) return static_cast<unsigned>(position);
  return static_cast<unsigned>(position < seam ? position % (spacing + 1) : (position - seam) % spacing);
}

/// The colours of an axis, those of the seam among them.
constexpr unsigned axis_colours(std::int64_t period, std::int64_t spacing) {
  const std::int64_t longer = period % spacing;
  if (longer == 0) return static_cast<unsigned>(spacing);
  return static_cast<unsigned>(period < longer * (spacing + 1) ? period : spacing + 1);
}

namespace checks {
/// Are equal colours never closer than the spacing, around the end too?
constexpr bool apart(std::int64_t period, std::int64_t spacing) {
  for (std::int64_t a = 0; a < period; ++a)
    for (std::int64_t step = 1; step < spacing && step < period; ++step)
      if (axis_colour(a, period, spacing) == axis_colour((a + step) % period, period, spacing) ||
          axis_colour(a, period, spacing) >= axis_colours(period, spacing))
        return false;
  return true;
}
constexpr bool apart_for_all() {
  for (std::int64_t spacing = 2; spacing <= 4; ++spacing)
    for (std::int64_t period = 1; period <= 40; ++period)
      if (!apart(period, spacing)) return false;
  return true;
}
static_assert(apart_for_all());
static_assert(axis_colours(0, 3) == 3 && axis_colours(6, 3) == 3 && axis_colours(8, 3) == 4 &&
              axis_colours(16, 3) == 4);
static_assert(axis_colours(4, 3) == 4 && axis_colours(5, 3) == 5 && axis_colours(8, 2) == 2);
}  // namespace checks

}  // namespace pairsum::pattern

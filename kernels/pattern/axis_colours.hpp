#pragma once
#include <array>
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

/// The colour of a base block of the talk by its lowest cell, not negative: blocks are 2 cells wide. Where no period is
/// odd these are the parities, bit d being that of component d.
template <std::size_t D>
constexpr unsigned block_colour(const std::array<std::int64_t, D>& base, const std::array<std::int64_t, D>& period) {
  unsigned colour = 0;
  for (std::size_t d = D; d-- > 0;) colour = colour * axis_colours(period[d], 2) + axis_colour(base[d], period[d], 2);
  return colour;
}
template <std::size_t D>
constexpr unsigned block_colours(const std::array<std::int64_t, D>& period) {
  unsigned colours = 1;
  for (const std::int64_t p : period) colours *= axis_colours(p, 2);
  return colours;
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
static_assert(block_colours<3>({0, 4, 8}) == 8 && block_colour<3>({5, 2, 3}, {0, 4, 8}) == 0b101);
static_assert(block_colours<3>({3, 3, 3}) == 27 && block_colours<2>({3, 8}) == 6 &&
              block_colour<2>({2, 3}, {3, 8}) == 5);
}  // namespace checks

}  // namespace pairsum::pattern

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/report/measured.hpp"
#include "harness/stats/ratio.hpp"

/// What comparisons of points need: which may be compared, and their ratio.
namespace pairsum::harness {

/// Base time over other time of one phase, paired inside the rounds that both were measured in; unpaired, with a
/// caveat, if there is none. Both must have a comparable_time.
ratio_estimate ratio_of(const measurements& all, const measured_point& base, const measured_point& other,
                        std::vector<std::string>& caveats, std::optional<double> phases::*phase = &phases::sum_s);

/// Has the summation been timed in every round?
bool is_timed(const measured_point& p);

/// Of the points that differ from `p` in granularity alone, is it the one with the shortest median of that phase?
/// Backends are compared as they are at their best.
bool has_best_granularity(const measurements& all, const measured_point& p,
                          std::optional<double> phases::*phase = &phases::sum_s);

/// The point that differs from `p` in what `change(point&)` does to it; nullptr if it was not measured.
template <class Change>
const measured_point* counterpart(const measurements& all, const measured_point& p, Change change) {
  point wanted = p.point;
  change(wanted);
  for (const measured_point& q : all.points)
    if (q.series == p.series && q.point == wanted) return &q;
  return nullptr;
}

/// A point's M, null where its grid takes none.
nlohmann::json m_or_null(const point& p);

/// Do two points sum on the same instruction set, or each on what its backend is made for: vector units, or none? (One
/// that this build does not know is made for none.)
bool have_like_isa(const point& p, const point& q);

/// The keys of an entry that say where a point stands: series, case, state, dx, backend, grid, granularity, isa, block,
/// M, threads.
nlohmann::json place_of(const measured_point& p);

/// The median of a phase or null.
nlohmann::json time_or_null(const measured_point& p, std::optional<double> phases::*phase);

}  // namespace pairsum::harness

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/report/compared_points.hpp"
#include "harness/report/comparisons.hpp"
#include "harness/report/judged_entries.hpp"
#include "harness/stats/interval.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// The share of the distance tests that would not be made if no cells were folded together.
json collision_share(const measured_point& p) {
  if (!p.work || !p.work->pairs_tested_unfolded || p.work->pairs_tested == 0) return nullptr;
  return 1 - static_cast<double>(*p.work->pairs_tested_unfolded) / static_cast<double>(p.work->pairs_tested);
}

/// Of the points that differ from `p` in M alone, the one with the shortest step.
const measured_point* best_M(const measurements& all, const measured_point& p) {
  const measured_point* best = nullptr;
  for (const measured_point& q : all.points) {
    point like = q.point;
    like.M = p.point.M;
    const auto time = comparable_time(q, &phases::total_s);
    if (q.point.M == 0 || q.series != p.series || !(like == p.point) || !time) continue;
    if (best == nullptr || *time < *median_of(*best, &phases::total_s)) best = &q;
  }
  return best;
}

json m_entry(const measured_point& p) {
  json entry = place_of(p);
  entry["time_s"] = time_or_null(p, &phases::sum_s);
  const auto bounds = is_timed(p) ? median_interval(values_of(p, &phases::sum_s)) : std::nullopt;
  entry["low"] = bounds ? json(bounds->low) : json(nullptr);
  entry["high"] = bounds ? json(bounds->high) : json(nullptr);
  entry["total_s"] = time_or_null(p, &phases::total_s);
  const json work = p.work ? json(*p.work) : json::object();
  for (const char* key : {"cells", "cells_nonempty", "pairs_tested", "pairs_interacting"})
    entry[key] = work.value(key, json(nullptr));
  entry["collision_share"] = collision_share(p);
  entry["useful_pair_ratio"] = useful_pair_ratio(p);
  entry["best_M"] = nullptr;
  entry["over_best"] = nullptr;
  return entry;
}

}  // namespace

json useful_pair_ratio(const measured_point& p) {
  if (!p.work || p.work->pairs_tested == 0) return nullptr;
  return static_cast<double>(p.work->pairs_interacting) / static_cast<double>(p.work->pairs_tested);
}

json m_comparisons(const measurements& all, std::vector<std::string>& caveats) {
  judged_entries entries;
  for (const measured_point& p : all.points) {
    if (p.point.M == 0) continue;
    json entry = m_entry(p);
    ratio_estimate best_over_own;
    const measured_point* const best = best_M(all, p);
    if (best != nullptr) entry["best_M"] = best->point.M;
    if (best == &p) {
      entry["over_best"] = 1.0;
    } else if (best != nullptr && comparable_time(p, &phases::total_s)) {
      best_over_own = ratio_of(all, *best, p, caveats, &phases::total_s);
      entry["over_best"] = 1 / best_over_own.value;
    }
    entries.add(std::move(entry), best_over_own);
  }
  json judged = std::move(entries).judged();
  // Neighbours differ in M.
  std::stable_sort(judged.begin(), judged.end(), [](const json& a, const json& b) {
    for (const char* key : {"series", "backend", "grid", "granularity", "isa", "block", "threads"})
      if (a[key] != b[key]) return a[key] < b[key];
    return a["M"] < b["M"];
  });
  return judged;
}

}  // namespace pairsum::harness

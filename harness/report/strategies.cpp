#include "harness/report/strategies.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "harness/report/compared_points.hpp"
#include "harness/report/judged_entries.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// A ratio as {"value", "low", "high", "confidence", "rounds"}, divided by `by`.
json estimate(const ratio_estimate& r, double by = 1) {
  json e{{"value", r.value / by}, {"rounds", r.pairs}};
  put_bounds(e, r.bounds ? std::optional(interval{r.bounds->low / by, r.bounds->high / by, r.bounds->confidence})
                         : std::nullopt);
  return e;
}

/// What keeping threads apart costs where there are none to keep apart (locks and copies per thread are not there
/// then): time on one thread over that of the serial sweep on the same cells. Null for other numbers of threads.
json over_serial(const measurements& all, const rung& own) {
  if (own.p->point.threads != 1) return nullptr;
  const std::string serial = "sphysics_sweep";
  for (const measured_point& q : all.points) {
    const point &a = q.point, &b = own.p->point;
    if (q.series != own.p->series || a.backend != serial || a.grid != b.grid || a.M != b.M) continue;
    if (!have_like_isa(a, b)) continue;
    const round_values times = evaluations_of(q);
    if (!times.empty()) return estimate(ratio_of(own.times, times));
  }
  return nullptr;
}

/// Speedup over the same on one thread, per thread; null on one.
json efficiency(const measurements& all, const rung& own) {
  if (own.p->point.threads == 1) return nullptr;
  const measured_point* const one = counterpart(all, *own.p, [](point& p) { p.threads = 1; });
  const round_values times = one != nullptr ? evaluations_of(*one) : round_values();
  return times.empty() ? json(nullptr) : estimate(ratio_of(times, own.times), own.p->point.threads);
}

/// The least that a backend of the ladder holds; 0 if that is not known of any.
std::uint64_t leanest(const ladder& l) {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  for (const rung& r : l.rungs)
    if (r.p->workspace_bytes) least = std::min(least, *r.p->workspace_bytes);
  return least == std::numeric_limits<std::uint64_t>::max() ? 0 : least;
}

void put_memory(json& entry, const measured_point& p, std::uint64_t least) {
  entry["workspace_bytes"] = p.workspace_bytes ? json(*p.workspace_bytes) : json(nullptr);
  entry["extra_bytes"] = p.workspace_bytes ? json(*p.workspace_bytes - least) : json(nullptr);
  const bool known = p.workspace_bytes && p.point.n_fluid > 0;
  entry["extra_bytes_per_particle"] =
      known ? json(static_cast<double>(*p.workspace_bytes - least) / static_cast<double>(p.point.n_fluid))
            : json(nullptr);
}

/// Where it stands, and what it is compared with.
json entry_of(const measurements& all, const measured_point& p, double time_s, const rung& base) {
  json entry = place_of(p);
  entry["world"] = world_words(all, p.series);
  entry["time_s"] = time_s;
  entry["base_backend"] = base.p->point.backend;
  entry["base_threads"] = base.p->point.threads;
  entry["base_time_s"] = base.time_s;
  return entry;
}

}  // namespace

json strategy_ladder(const measurements& all, const std::vector<ladder>& ladders) {
  judged_entries entries;
  for (const ladder& l : ladders) {
    const std::uint64_t least = leanest(l);
    for (std::size_t k = 0; k < l.rungs.size(); ++k) {
      const rung& own = l.rungs[k];
      json entry = entry_of(all, *own.p, own.time_s, l.base_rung());
      entry["at"] = l.at;
      entry["rank"] = k + 1;
      entry["of"] = l.rungs.size();
      entry["over_serial"] = over_serial(all, own);
      entry["efficiency"] = efficiency(all, own);
      const auto waiting = wait_share(*own.p);
      entry["wait_share"] = waiting ? json(*waiting) : json(nullptr);
      put_memory(entry, *own.p, least);
      ratio_estimate ratio = ratio_of(l.base_rung().times, own.times);
      if (k == l.base) ratio.p_value.reset();  // the base itself is no comparison
      entries.add(std::move(entry), "ratio", ratio);
    }
  }
  return std::move(entries).judged();
}

json strategy_threads(const measurements& all, const std::vector<ladder>& ladders) {
  json entries = json::array();
  for (const ladder& l : ladders) {
    if (l.at != "most_threads") continue;
    const auto one = std::ranges::find_if(
        ladders, [&](const ladder& other) { return other.series == l.series && other.at == "one_thread"; });
    if (one == ladders.end()) continue;
    for (const rung& best : l.rungs)
      for (const measured_point& p : all.points) {
        point like = p.point;
        like.threads = best.p->point.threads;
        const round_values times = p.series == l.series && like == best.p->point ? evaluations_of(p) : round_values();
        if (times.empty()) continue;
        json entry = entry_of(all, p, median_of(times), one->base_rung());
        const ratio_estimate ratio = ratio_of(one->base_rung().times, times);
        entry["ratio"] = ratio.value;
        put_bounds(entry, ratio.bounds);
        entry["rounds"] = ratio.pairs;
        entries.push_back(std::move(entry));
      }
  }
  return entries;
}

}  // namespace pairsum::harness

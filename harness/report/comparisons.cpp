#include "harness/report/comparisons.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/stats/holm.hpp"
#include "harness/stats/interval.hpp"
#include "harness/stats/ratio.hpp"
#include "harness/stats/speedup.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

bool comparable(const measured_point& p) {
  const auto time = median_of(p, &phases::sum_s);
  return time && *time > 0;
}

const measured_point* find(const measurements& all, std::size_t series, const std::string& backend,
                           const std::string& grid, const std::string& granularity, int M, int threads) {
  for (const measured_point& p : all.points)
    if (p.series == series && p.point.backend == backend && p.point.grid == grid && p.point.M == M &&
        p.point.threads == threads && (granularity.empty() || p.point.granularity == granularity))
      return comparable(p) ? &p : nullptr;
  return nullptr;
}

json head(const measured_point& p) {
  return {{"series", p.series}, {"case", p.point.case_name}, {"state", p.point.state}, {"dx", p.point.dx}};
}

/// Entries of a table with their ratios, which are judged together.
class judged_entries {
 public:
  void add(json entry, const char* key, const ratio_estimate& ratio) {
    entry[key] = ratio.value;
    entry["low"] = ratio.bounds ? json(ratio.bounds->low) : json(nullptr);
    entry["high"] = ratio.bounds ? json(ratio.bounds->high) : json(nullptr);
    entry["confidence"] = ratio.bounds ? json(ratio.bounds->confidence) : json(nullptr);
    entry["rounds"] = ratio.pairs;
    entries_.push_back(std::move(entry));
    ratios_.push_back(ratio);
  }
  /// An entry whose `ratio` is that of the best M's step time over its own; written as "over_best", the other way
  /// round.
  void add_judged_only(json entry, const ratio_estimate& ratio) {
    if (ratio.value > 0) entry["over_best"] = 1 / ratio.value;
    entries_.push_back(std::move(entry));
    ratios_.push_back(ratio);
  }
  /// With the verdicts after Holm's correction.
  json judged() && {
    const std::vector<ratio_verdict> verdicts = verdicts_of(ratios_);
    for (std::size_t k = 0; k < verdicts.size(); ++k) entries_[k]["verdict"] = word_of(verdicts[k]);
    return std::move(entries_);
  }

 private:
  json entries_ = json::array();
  std::vector<ratio_estimate> ratios_;
};

/// The machine's own scaling from one thread to so many, by its peaks; null if they were not measured.
json peak_scaling(const measurements& all, const measured_point& p, double peak_row::*peak) {
  const peak_row* one = nullptr;
  const peak_row* own = nullptr;
  for (const peak_row& q : all.peaks) {
    if (q.environment != all.series[p.series].environment || q.precision != p.point.precision) continue;
    if (q.threads == 1) one = &q;
    if (q.threads == p.point.threads) own = &q;
  }
  return one != nullptr && own != nullptr ? json(own->*peak / (one->*peak)) : json(nullptr);
}

/// The part of a backend's name behind "naive", "symmetric": "", "_omp" or "_tbb".
const char* const runtime_suffixes[] = {"", "_omp", "_tbb"};
const char* const runtime_names[] = {"serial", "omp", "tbb"};

bool has_siblings(const measurements& all, const measured_point& p) {
  for (const measured_point& q : all.points)
    if (q.series == p.series && q.point.backend == p.point.backend && q.point.grid == p.point.grid &&
        q.point.granularity == p.point.granularity && q.point.M == p.point.M && q.point.threads != p.point.threads)
      return true;
  return false;
}

json time_or_null(const measured_point& p, std::optional<double> phases::*phase) {
  const auto time = median_of(p, phase);
  return time ? json(*time) : json(nullptr);
}

}  // namespace

ratio_estimate ratio_of(const measurements& all, const measured_point& base, const measured_point& other,
                        std::vector<std::string>& caveats, std::optional<double> phases::*phase) {
  std::vector<double> base_times, other_times;
  for (const auto& [round, value] : base.rounds) {
    const auto match = other.rounds.find(round);
    if (match == other.rounds.end() || !(value.mean.*phase) || !(match->second.mean.*phase)) continue;
    base_times.push_back(*(value.mean.*phase));
    other_times.push_back(*(match->second.mean.*phase));
  }
  if (!base_times.empty()) return paired_ratio(base_times, other_times);
  caveats.push_back(label(all, base) + " and " + label(all, other) +
                    " were measured in different rounds: their ratio is not paired");
  return unpaired_ratio(values_of(base, phase), values_of(other, phase));
}

json thread_speedups(const measurements& all, std::vector<std::string>& caveats) {
  judged_entries entries;
  std::vector<std::string> without_base;
  for (const measured_point& own : all.points) {
    const point& p = own.point;
    if (!comparable(own) || (p.threads == 1 && !has_siblings(all, own))) continue;
    const measured_point* base = find(all, own.series, p.backend, p.grid, p.granularity, p.M, 1);
    if (base == nullptr) {
      if (p.threads > 1) without_base.push_back(label(all, own));
      continue;
    }
    ratio_estimate ratio = ratio_of(all, *base, own, caveats);
    if (base == &own) ratio.p_value.reset();  // the base itself is no comparison
    const speedup s({label(base->point), *median_of(*base, &phases::sum_s)}, ratio);
    json entry = head(own);
    entry["M"] = p.M;
    entry["backend"] = p.backend;
    entry["grid"] = p.grid;
    entry["granularity"] = p.granularity;
    entry["threads"] = p.threads;
    entry["time_s"] = time_or_null(own, &phases::sum_s);
    entry["base_backend"] = p.backend;
    entry["base_threads"] = 1;
    entry["base_time_s"] = s.base().time_s;
    entry["efficiency"] = s.efficiency(p.threads);
    entry["machine_flops_scaling"] = peak_scaling(all, own, &peak_row::flops_per_s);
    entry["machine_bandwidth_scaling"] = peak_scaling(all, own, &peak_row::bandwidth_bytes_per_s);
    entries.add(std::move(entry), "speedup", s.ratio());
  }
  if (!without_base.empty())
    caveats.push_back("no speedup over 1 thread, which was not measured: " + first_few(without_base));
  return std::move(entries).judged();
}

json algorithm_speedups(const measurements& all, std::vector<std::string>& caveats) {
  judged_entries entries;
  for (int runtime = 0; runtime < 3; ++runtime) {
    const std::string naive = std::string("naive") + runtime_suffixes[runtime];
    const std::string symmetric = std::string("symmetric") + runtime_suffixes[runtime];
    for (const measured_point& base : all.points)
      for (const measured_point& own : all.points) {
        const point &p = base.point, &q = own.point;
        if (p.backend != naive || q.backend != symmetric || own.series != base.series || p.grid != q.grid ||
            p.threads != q.threads || !comparable(base) || !comparable(own))
          continue;
        // Each M with itself, and the talk's second definition: naive at M = 7 over symmetric at M = 6.
        if (p.M != q.M && !(p.M == 7 && q.M == 6)) continue;
        const speedup s({label(p), *median_of(base, &phases::sum_s)}, ratio_of(all, base, own, caveats));
        json entry = head(own);
        entry["runtime"] = runtime_names[runtime];
        entry["threads"] = q.threads;
        entry["base_backend"] = naive;
        entry["base_M"] = p.M;
        entry["base_granularity"] = p.granularity;
        entry["base_time_s"] = s.base().time_s;
        entry["backend"] = symmetric;
        entry["grid"] = q.grid;
        entry["granularity"] = q.granularity;
        entry["M"] = q.M;
        entry["time_s"] = time_or_null(own, &phases::sum_s);
        entries.add(std::move(entry), "speedup", s.ratio());
      }
  }
  return std::move(entries).judged();
}

json runtime_comparisons(const measurements& all, std::vector<std::string>& caveats) {
  judged_entries entries;
  for (const measured_point& omp : all.points) {
    const point& p = omp.point;
    const std::size_t stem = p.backend.size() < 4 ? 0 : p.backend.size() - 4;
    if (p.backend.substr(stem) != "_omp" || !comparable(omp)) continue;
    const std::string algorithm = p.backend.substr(0, stem);
    const measured_point* tbb = find(all, omp.series, algorithm + "_tbb", p.grid, "", p.M, p.threads);
    if (tbb == nullptr) continue;
    json entry = head(omp);
    entry["algorithm"] = algorithm;
    entry["grid"] = p.grid;
    entry["granularity"] = p.granularity;
    entry["M"] = p.M;
    entry["threads"] = p.threads;
    entry["omp_time_s"] = time_or_null(omp, &phases::sum_s);
    entry["tbb_time_s"] = time_or_null(*tbb, &phases::sum_s);
    entries.add(std::move(entry), "ratio", ratio_of(all, omp, *tbb, caveats));
  }
  return std::move(entries).judged();
}

json compiler_comparisons(const measurements& all, std::vector<std::string>& caveats) {
  judged_entries entries;
  if (!all.compares_builds) return json::array();
  for (const measured_point& base : all.points)
    for (const measured_point& own : all.points) {
      const series &a = all.series[base.series], &b = all.series[own.series];
      if (a.build != 0 || b.build == 0 || a.study != b.study || !(base.point == own.point)) continue;
      if (!comparable(base) || !comparable(own)) continue;
      json entry = head(own);
      entry["backend"] = own.point.backend;
      entry["grid"] = own.point.grid;
      entry["granularity"] = own.point.granularity;
      entry["M"] = own.point.M;
      entry["threads"] = own.point.threads;
      entry["base_compiler"] = a.build_name;
      entry["base_time_s"] = time_or_null(base, &phases::sum_s);
      entry["compiler"] = b.build_name;
      entry["time_s"] = time_or_null(own, &phases::sum_s);
      entries.add(std::move(entry), "ratio", ratio_of(all, base, own, caveats));
    }
  return std::move(entries).judged();
}

json useful_pair_ratio(const measured_point& p) {
  if (!p.work || p.work->pairs_tested == 0) return nullptr;
  return static_cast<double>(p.work->pairs_interacting) / static_cast<double>(p.work->pairs_tested);
}

namespace {

json collision_share(const measured_point& p) {
  if (!p.work || !p.work->pairs_tested_unfolded || p.work->pairs_tested == 0) return nullptr;
  return 1 - static_cast<double>(*p.work->pairs_tested_unfolded) / static_cast<double>(p.work->pairs_tested);
}

}  // namespace

namespace {

/// Of the points that differ from `p` in M alone, the one with the shortest step.
const measured_point* best_M(const measurements& all, const measured_point& p) {
  const measured_point* best = nullptr;
  for (const measured_point& q : all.points) {
    point like = q.point;
    like.M = p.point.M;
    const auto time = median_of(q, &phases::total_s);
    if (q.series != p.series || !(like == p.point) || !time || !(*time > 0)) continue;
    if (best == nullptr || *time < *median_of(*best, &phases::total_s)) best = &q;
  }
  return best;
}

}  // namespace

json m_comparisons(const measurements& all, std::vector<std::string>& caveats) {
  judged_entries entries;
  for (const measured_point& p : all.points) {
    json entry = head(p);
    entry["backend"] = p.point.backend;
    entry["grid"] = p.point.grid;
    entry["granularity"] = p.point.granularity;
    entry["threads"] = p.point.threads;
    entry["M"] = p.point.M;
    entry["time_s"] = time_or_null(p, &phases::sum_s);
    const auto bounds = comparable(p) ? median_interval(values_of(p, &phases::sum_s)) : std::nullopt;
    entry["low"] = bounds ? json(bounds->low) : json(nullptr);
    entry["high"] = bounds ? json(bounds->high) : json(nullptr);
    entry["collision_share"] = collision_share(p);
    entry["total_s"] = time_or_null(p, &phases::total_s);
    const json work = p.work ? json(*p.work) : json::object();
    for (const char* key : {"cells", "cells_nonempty", "pairs_tested", "pairs_interacting"})
      entry[key] = work.value(key, json(nullptr));
    entry["useful_pair_ratio"] = useful_pair_ratio(p);
    const measured_point* const best = best_M(all, p);
    entry["best_M"] = best != nullptr ? json(best->point.M) : json(nullptr);
    ratio_estimate ratio;
    if (best == &p) ratio.value = 1;
    if (best != nullptr && best != &p && median_of(p, &phases::total_s).value_or(0) > 0)
      ratio = ratio_of(all, *best, p, caveats, &phases::total_s);
    entry["over_best"] = nullptr;
    entries.add_judged_only(std::move(entry), ratio);
  }
  json judged = std::move(entries).judged();
  // Neighbours differ in M.
  std::stable_sort(judged.begin(), judged.end(), [](const json& a, const json& b) {
    for (const char* key : {"series", "backend", "grid", "granularity", "threads"})
      if (a[key] != b[key]) return a[key] < b[key];
    return a["M"] < b["M"];
  });
  return judged;
}

}  // namespace pairsum::harness

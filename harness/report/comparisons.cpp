#include "harness/report/comparisons.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "harness/stats/speedup.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// Summation times of one point by (file, round, repetition), in the order of the slots.
using times_by_repetition = std::map<std::tuple<std::size_t, int, int>, std::vector<double>>;

times_by_repetition sum_times(const measured_point& point) {
  times_by_repetition times;
  for (const auto& entry : point.repetitions)
    if (entry.second.sum_s && *entry.second.sum_s > 0)
      times[{entry.first.file, entry.first.round, entry.first.repetition}].push_back(*entry.second.sum_s);
  return times;
}

bool comparable(const measured_point& p) {
  const auto time = median_of(p, &phases::sum_s);
  return time && *time > 0;
}

/// Base time over other time; both must be comparable.
ratio_estimate compare(const measurements& all, const measured_point& base, const measured_point& other,
                       std::vector<std::string>& caveats) {
  std::vector<double> base_times, other_times;
  const times_by_repetition others = sum_times(other);
  for (const auto& entry : sum_times(base)) {
    const auto match = others.find(entry.first);
    if (match == others.end()) continue;
    for (std::size_t i = 0; i < std::min(entry.second.size(), match->second.size()); ++i) {
      base_times.push_back(entry.second[i]);
      other_times.push_back(match->second[i]);
    }
  }
  if (!base_times.empty()) return paired_ratio(base_times, other_times);
  caveats.push_back(label(all, base) + " and " + label(all, other) + " share no repetition: their ratio is not paired");
  return unpaired_ratio(values_of(base, &phases::sum_s), values_of(other, &phases::sum_s));
}

const measured_point* find(const measurements& all, std::size_t series, const std::string& backend,
                           const std::string& grid, int M, int threads) {
  for (const measured_point& p : all.points)
    if (p.series == series && p.point.backend == backend && p.point.grid == grid && p.point.M == M &&
        p.point.threads == threads)
      return comparable(p) ? &p : nullptr;
  return nullptr;
}

json head(const measured_point& p) {
  return {{"series", p.series}, {"case", p.point.case_name}, {"state", p.point.state}, {"dx", p.point.dx}};
}

void put_ratio(json& entry, const char* key, double value, const std::optional<interval>& bounds) {
  entry[key] = value;
  entry["low"] = bounds ? json(bounds->low) : json(nullptr);
  entry["high"] = bounds ? json(bounds->high) : json(nullptr);
}

speedup speedup_over(const measurements& all, const measured_point& base, const measured_point& own,
                     std::vector<std::string>& caveats) {
  return speedup({label(base.point), *median_of(base, &phases::sum_s)}, compare(all, base, own, caveats));
}

/// The part of a backend's name behind "naive", "symmetric": "", "_omp" or "_tbb".
const char* const runtime_suffixes[] = {"", "_omp", "_tbb"};
const char* const runtime_names[] = {"serial", "omp", "tbb"};

bool has_siblings(const measurements& all, const measured_point& p) {
  for (const measured_point& q : all.points)
    if (q.series == p.series && q.point.backend == p.point.backend && q.point.grid == p.point.grid &&
        q.point.M == p.point.M && q.point.threads != p.point.threads)
      return true;
  return false;
}

json time_or_null(const measured_point& p, std::optional<double> phases::*phase) {
  const auto time = median_of(p, phase);
  return time ? json(*time) : json(nullptr);
}

}  // namespace

json thread_speedups(const measurements& all, std::vector<std::string>& caveats) {
  json entries = json::array();
  std::vector<std::string> without_base;
  for (const measured_point& own : all.points) {
    const point& p = own.point;
    if (!comparable(own) || (p.threads == 1 && !has_siblings(all, own))) continue;
    const measured_point* base = find(all, own.series, p.backend, p.grid, p.M, 1);
    if (base == nullptr) {
      without_base.push_back(label(all, own));
      continue;
    }
    const speedup s = speedup_over(all, *base, own, caveats);
    json entry = head(own);
    entry["M"] = p.M;
    entry["backend"] = p.backend;
    entry["grid"] = p.grid;
    entry["threads"] = p.threads;
    entry["time_s"] = time_or_null(own, &phases::sum_s);
    entry["base_backend"] = p.backend;
    entry["base_threads"] = 1;
    entry["base_time_s"] = s.base().time_s;
    put_ratio(entry, "speedup", s.value(), s.bounds());
    entry["efficiency"] = s.efficiency(p.threads);
    entries.push_back(entry);
  }
  if (!without_base.empty())
    caveats.push_back("no speedup, the base on 1 thread is missing: " + first_few(without_base));
  return entries;
}

json algorithm_speedups(const measurements& all, std::vector<std::string>& caveats) {
  json entries = json::array();
  for (int runtime = 0; runtime < 3; ++runtime) {
    const std::string naive = std::string("naive") + runtime_suffixes[runtime];
    const std::string symmetric = std::string("symmetric") + runtime_suffixes[runtime];
    for (const measured_point& base : all.points) {
      const point& p = base.point;
      if (p.backend != naive || !comparable(base) || (p.M != 6 && p.M != 7)) continue;  // the talk's two definitions
      const measured_point* own = find(all, base.series, symmetric, p.grid, 6, p.threads);
      if (own == nullptr) continue;
      const speedup s = speedup_over(all, base, *own, caveats);
      json entry = head(*own);
      entry["runtime"] = runtime_names[runtime];
      entry["threads"] = p.threads;
      entry["base_backend"] = naive;
      entry["base_M"] = p.M;
      entry["base_time_s"] = s.base().time_s;
      entry["backend"] = symmetric;
      entry["grid"] = p.grid;
      entry["M"] = 6;
      entry["time_s"] = time_or_null(*own, &phases::sum_s);
      put_ratio(entry, "speedup", s.value(), s.bounds());
      entries.push_back(entry);
    }
  }
  return entries;
}

json runtime_comparisons(const measurements& all, std::vector<std::string>& caveats) {
  json entries = json::array();
  for (const measured_point& omp : all.points) {
    const point& p = omp.point;
    const std::size_t stem = p.backend.size() < 4 ? 0 : p.backend.size() - 4;
    if (p.backend.substr(stem) != "_omp" || !comparable(omp)) continue;
    const std::string algorithm = p.backend.substr(0, stem);
    const measured_point* tbb = find(all, omp.series, algorithm + "_tbb", p.grid, p.M, p.threads);
    if (tbb == nullptr) continue;
    const ratio_estimate ratio = compare(all, omp, *tbb, caveats);
    json entry = head(omp);
    entry["algorithm"] = algorithm;
    entry["grid"] = p.grid;
    entry["M"] = p.M;
    entry["threads"] = p.threads;
    entry["omp_time_s"] = time_or_null(omp, &phases::sum_s);
    entry["tbb_time_s"] = time_or_null(*tbb, &phases::sum_s);
    put_ratio(entry, "ratio", ratio.value, ratio.bounds);
    entries.push_back(entry);
  }
  return entries;
}

json useful_pair_ratio(const measured_point& p) {
  if (!p.work || p.work->pairs_tested == 0) return nullptr;
  return static_cast<double>(p.work->pairs_interacting) / static_cast<double>(p.work->pairs_tested);
}

json m_comparisons(const measurements& all) {
  json entries = json::array();
  for (const measured_point& p : all.points) {
    json entry = head(p);
    entry["backend"] = p.point.backend;
    entry["grid"] = p.point.grid;
    entry["threads"] = p.point.threads;
    entry["M"] = p.point.M;
    entry["time_s"] = time_or_null(p, &phases::sum_s);
    entry["total_s"] = time_or_null(p, &phases::total_s);
    const json work = p.work ? json(*p.work) : json::object();
    for (const char* key : {"cells", "cells_nonempty", "pairs_tested", "pairs_interacting"})
      entry[key] = work.value(key, json(nullptr));
    entry["useful_pair_ratio"] = useful_pair_ratio(p);
    entries.push_back(entry);
  }
  // Neighbours differ in M.
  std::stable_sort(entries.begin(), entries.end(), [](const json& a, const json& b) {
    for (const char* key : {"series", "backend", "grid", "threads"})
      if (a[key] != b[key]) return a[key] < b[key];
    return a["M"] < b["M"];
  });
  return entries;
}

}  // namespace pairsum::harness

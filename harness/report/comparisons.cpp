#include "harness/report/comparisons.hpp"

#include <nlohmann/json.hpp>

#include "harness/report/compared_points.hpp"
#include "harness/report/judged_entries.hpp"
#include "harness/stats/interval.hpp"
#include "harness/stats/median.hpp"
#include "harness/stats/speedup.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

bool has_other_threads(const measurements& all, const measured_point& p) {
  for (const measured_point& q : all.points) {
    point like = q.point;
    like.threads = p.point.threads;
    if (q.series == p.series && like == p.point && q.point.threads != p.point.threads) return true;
  }
  return false;
}

/// The machine's own scaling from one thread to so many, by its peaks; null if they were not measured.
json peak_scaling(const measurements& all, const measured_point& p, double peak_row::*peak) {
  const peak_row* const one = peak_of(all, p, 1);
  const peak_row* const own = peak_of(all, p, p.point.threads);
  return one != nullptr && own != nullptr ? json(own->*peak / (one->*peak)) : json(nullptr);
}

/// The median over rounds with its interval; all null without rounds.
json median_over_rounds(const std::vector<double>& values) {
  json estimate{{"value", values.empty() ? json(nullptr) : json(median(values))}, {"rounds", values.size()}};
  put_bounds(estimate, values.empty() ? std::nullopt : median_interval(values));
  return estimate;
}

/// How many times as many multiply-adds the machine makes on the threads of `own` as on those of `base`, in the rounds
/// in which both were summed, and what part of that the sums reach: (t_base f_base)/(t_own f_own) of each round.
/// Medians, because what disturbs a round hits the two differently: threads that share a core for a while halve the
/// multiply-adds and may leave a sum as it was.
void put_machine(json& entry, const measurements& all, const measured_point& base, const measured_point& own) {
  std::vector<double> machine, share;
  const auto pace = [&](const measured_point& p, const round_key& round) {
    const series& s = all.series[p.series];
    const auto at = all.paces.find({round, s.study, s.build, p.point.threads, p.point.precision});
    return at == all.paces.end() ? 0.0 : at->second;
  };
  for (const auto& [round, value] : base.rounds) {
    const auto match = own.rounds.find(round);
    if (match == own.rounds.end() || !value.mean.sum_s || !match->second.mean.sum_s) continue;
    const double of_base = pace(base, round), of_own = pace(own, round);
    if (!(of_base > 0 && of_own > 0)) continue;
    machine.push_back(of_own / of_base);
    share.push_back(*value.mean.sum_s / *match->second.mean.sum_s / machine.back());
  }
  entry["machine_speedup"] = median_over_rounds(machine);
  entry["of_machine"] = median_over_rounds(share);
}

/// The gather and the symmetric sum that differ in nothing else, by runtime.
struct algorithm_pair {
  const char *naive, *symmetric, *runtime;
};
constexpr algorithm_pair algorithm_pairs[] = {{"naive", "symmetric", "serial"},
                                              {"naive_omp", "symmetric_omp", "omp"},
                                              {"naive_tbb", "symmetric_tbb", "tbb"},
                                              {"naive_tiles_omp", "tiles_omp", "omp"}};

/// May they stand for naive over symmetric: each M with itself, and the talk's second definition, naive at M = 7 over
/// symmetric at M = 6?
bool is_algorithm_pair(const measurements& all, const measured_point& naive, const measured_point& symmetric) {
  const point &p = naive.point, &q = symmetric.point;
  return naive.series == symmetric.series && p.grid == q.grid && p.threads == q.threads &&
         (p.M == q.M || (p.M == 7 && q.M == 6)) && p.isa == q.isa && p.block == q.block &&
         has_best_granularity(all, naive) && has_best_granularity(all, symmetric);
}

json algorithm_entry(const measured_point& base, const measured_point& own, const char* runtime) {
  json entry = place_of(own);
  entry["runtime"] = runtime;
  entry["base_backend"] = base.point.backend;
  entry["base_M"] = m_or_null(base.point);
  entry["base_granularity"] = base.point.granularity;
  entry["base_time_s"] = time_or_null(base, &phases::sum_s);
  entry["time_s"] = time_or_null(own, &phases::sum_s);
  return entry;
}

}  // namespace

json thread_speedups(const measurements& all, std::vector<std::string>& caveats) {
  judged_entries entries;
  std::vector<std::string> without_base;
  for (const measured_point& own : all.points) {
    if (!is_timed(own) || (own.point.threads == 1 && !has_other_threads(all, own))) continue;
    const measured_point* const base = counterpart(all, own, [](point& p) { p.threads = 1; });
    if (base == nullptr || !is_timed(*base)) {
      if (own.point.threads > 1) without_base.push_back(label(all, own));
      continue;
    }
    ratio_estimate ratio = ratio_of(all, *base, own, caveats);
    if (base == &own) ratio.p_value.reset();  // the base itself is no comparison
    const speedup s({label(base->point), *median_of(*base, &phases::sum_s)}, ratio);
    json entry = place_of(own);
    entry["time_s"] = time_or_null(own, &phases::sum_s);
    entry["base_backend"] = base->point.backend;
    entry["base_threads"] = 1;
    entry["base_time_s"] = s.base().time_s;
    entry["efficiency"] = s.efficiency(own.point.threads);
    entry["machine_flops_scaling"] = peak_scaling(all, own, &peak_row::flops_per_s);
    entry["machine_bandwidth_scaling"] = peak_scaling(all, own, &peak_row::bandwidth_bytes_per_s);
    put_machine(entry, all, *base, own);
    entries.add(std::move(entry), "speedup", s.ratio());
  }
  if (!without_base.empty())
    caveats.push_back("no speedup over 1 thread, which was not measured: " + first_few(without_base));
  return std::move(entries).judged();
}

json algorithm_speedups(const measurements& all, std::vector<std::string>& caveats) {
  judged_entries entries;
  for (const algorithm_pair& pair : algorithm_pairs)
    for (const measured_point& base : all.points) {
      if (base.point.backend != pair.naive) continue;
      for (const measured_point& own : all.points)
        if (own.point.backend == pair.symmetric && is_algorithm_pair(all, base, own))
          entries.add(algorithm_entry(base, own, pair.runtime), "speedup", ratio_of(all, base, own, caveats));
    }
  return std::move(entries).judged();
}

json runtime_comparisons(const measurements& all, std::vector<std::string>& caveats) {
  judged_entries entries;
  for (const measured_point& omp : all.points) {
    if (!omp.point.backend.ends_with("_omp") || !has_best_granularity(all, omp)) continue;
    const std::string algorithm = omp.point.backend.substr(0, omp.point.backend.size() - 4);
    for (const measured_point& tbb : all.points) {
      point like = omp.point;
      like.backend = algorithm + "_tbb";
      like.granularity = tbb.point.granularity;
      if (tbb.series != omp.series || !(tbb.point == like) || !has_best_granularity(all, tbb)) continue;
      json entry = place_of(omp);
      entry.erase("backend");
      entry["algorithm"] = algorithm;
      entry["tbb_granularity"] = tbb.point.granularity;
      entry["omp_time_s"] = time_or_null(omp, &phases::sum_s);
      entry["tbb_time_s"] = time_or_null(tbb, &phases::sum_s);
      entries.add(std::move(entry), "ratio", ratio_of(all, omp, tbb, caveats));
    }
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
      if (!is_timed(base) || !is_timed(own)) continue;
      json entry = place_of(own);
      entry["base_compiler"] = a.build_name;
      entry["base_time_s"] = time_or_null(base, &phases::sum_s);
      entry["compiler"] = b.build_name;
      entry["time_s"] = time_or_null(own, &phases::sum_s);
      entries.add(std::move(entry), "ratio", ratio_of(all, base, own, caveats));
    }
  return std::move(entries).judged();
}

}  // namespace pairsum::harness

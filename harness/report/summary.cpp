#include "harness/report/summary.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include "harness/report/answer.hpp"
#include "harness/report/comparisons.hpp"
#include "harness/report/models.hpp"
#include "harness/report/self_tests.hpp"
#include "harness/report/strategies.hpp"
#include "harness/stats/interval.hpp"
#include "harness/stats/median.hpp"
#include "harness/stats/variance.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

json phase_entry(const measured_point& p, std::optional<double> phases::*phase) {
  json entry{{"median", nullptr}, {"low", nullptr}, {"high", nullptr}, {"confidence", nullptr}};
  const auto time = median_of(p, phase);
  if (!time) return entry;
  entry["median"] = *time;
  if (const auto bounds = median_interval(values_of(p, phase))) {
    entry["low"] = bounds->low;
    entry["high"] = bounds->high;
    entry["confidence"] = bounds->confidence;
  }
  return entry;
}

/// The phases that a backend needs to get the rates, with their keys in "ns_per_pair_parts".
constexpr phase_member pair_parts[] = {
    {"prepare", &phases::prepare_s}, {"zero", &phases::zero_s}, {"sum", &phases::sum_s}, {"reduce", &phases::reduce_s}};

/// The median over the rounds of the time of all parts together; empty if one of them was not timed in all rounds.
std::optional<double> median_of_all_parts(const measured_point& p) {
  std::vector<double> times;
  for (const auto& entry : p.rounds) {
    double time = 0;
    for (const phase_member& part : pair_parts) {
      const std::optional<double>& value = entry.second.mean.*part.value;
      if (!value) return std::nullopt;
      time += *value;
    }
    times.push_back(time);
  }
  return median(times);
}

json ns_per_pair(const measured_point& p, std::optional<double> time) {
  if (!time || !p.work || p.work->pairs_interacting == 0) return nullptr;
  return *time * 1e9 / static_cast<double>(p.work->pairs_interacting);
}

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

/// Scatter of the summation time between and within the rounds' processes.
json variance_entry(const measured_point& p) {
  std::vector<std::vector<double>> groups;
  for (const auto& [round, value] : p.rounds) {
    std::vector<double> times;
    for (const phases& repetition : value.repetitions)
      if (repetition.sum_s && *repetition.sum_s > 0) times.push_back(*repetition.sum_s);
    if (!times.empty()) groups.push_back(std::move(times));
  }
  if (groups.empty()) return {{"between", nullptr}, {"within", nullptr}};
  const variance_components found = components_of_variance(groups);
  return {{"between", or_null(found.between)}, {"within", or_null(found.within)}};
}

json passes_entry(const measured_point& p) {
  if (!p.busy_s || !p.waiting_s) return nullptr;
  return {{"busy_s", *p.busy_s}, {"barrier_wait_s", *p.waiting_s}, {"wait_share", or_null(wait_share(p))}};
}

json point_entry(const measurements& all, const measured_point& p) {
  json entry;
  entry["point"] = p.point;
  entry["study"] = all.series[p.series].study;
  entry["series"] = p.series;
  entry["rounds"] = p.rounds.size();
  entry["repetitions"] = p.repetitions;
  entry["round_s"] = values_of(p, &phases::sum_s);
  entry["variance"] = variance_entry(p);
  entry["passes"] = passes_entry(p);
  entry["model"] = model_entry(all, p);
  entry["counters"] = p.counters ? json(*p.counters) : json(nullptr);
  entry["steps"] = p.steps;
  for (const phase_member& phase : phase_members) entry["phases"][phase.name] = phase_entry(p, phase.value);
  entry["ns_per_pair"] = ns_per_pair(p, median_of(p, &phases::sum_s));
  for (const phase_member& part : pair_parts)
    entry["ns_per_pair_parts"][part.name] = ns_per_pair(p, median_of(p, part.value));
  entry["ns_per_pair_parts"]["all"] = ns_per_pair(p, median_of_all_parts(p));
  entry["useful_pair_ratio"] = useful_pair_ratio(p);
  entry["work"] = p.work ? json(*p.work) : json(nullptr);
  for (const char* in_model : {"flops", "bytes"})
    if (p.work) entry["work"].erase(in_model);
  entry["peak_rss_bytes"] = p.peak_rss_bytes ? json(*p.peak_rss_bytes) : json(nullptr);
  entry["workspace_bytes"] = p.workspace_bytes ? json(*p.workspace_bytes) : json(nullptr);
  entry["fingerprint"] = p.fingerprint;
  return entry;
}

json series_entry(const series& s) {
  json entry = s.common;
  for (const char* varied : {"backend", "grid", "granularity", "block", "M", "threads"}) entry.erase(varied);
  entry["isa"] = nullptr;  // a level of its points
  entry["study"] = s.study;
  entry["environment"] = s.environment;
  entry["build"] = s.build_name;
  entry["seed"] = s.seed ? json(*s.seed) : json(nullptr);
  return entry;
}

/// One caveat for all points of which the same is to be said.
template <class Says>
void add_point_caveat(const measurements& all, const std::string& what, Says says, std::vector<std::string>& caveats) {
  std::vector<std::string> points;
  for (const measured_point& p : all.points)
    if (says(p)) points.push_back(label(all, p));
  if (!points.empty()) caveats.push_back(what + ": " + first_few(points));
}

std::vector<std::string> without_repeats(const std::vector<std::string>& texts) {
  std::vector<std::string> unique;
  for (const std::string& text : texts)
    if (std::find(unique.begin(), unique.end(), text) == unique.end()) unique.push_back(text);
  return unique;
}

std::string title_of(const measurements& all) {
  std::vector<std::string> studies, hosts;
  for (const series& s : all.series) studies.push_back(s.study);
  for (const environment_row& e : all.environments) hosts.push_back(e.host);
  return join(without_repeats(studies)) + " on " + join(without_repeats(hosts));
}

}  // namespace

json build_summary(const measurements& all) {
  std::vector<std::string> caveats = all.caveats;
  add_point_caveat(
      all, "more threads than cores", [](const auto& p) { return p.point.threads > p.cores; }, caveats);
  add_point_caveat(
      all, "fewer than 6 rounds, so no interval of the median", [](const auto& p) { return p.rounds.size() < 6; },
      caveats);
  json summary;
  summary["schema"] = summary_schema;
  summary["sources"] = all.sources;
  summary["environments"] = all.environments;
  summary["title"] = title_of(all);
  summary["rounds"] = {
      {"finished", all.finished_rounds}, {"void", all.void_rounds}, {"others_share", or_null(all.others_share)}};
  summary["peaks"] = json::array();
  for (const peak_row& p : all.peaks)
    summary["peaks"].push_back({{"environment", p.environment},
                                {"threads", p.threads},
                                {"precision", p.precision},
                                {"bandwidth_bytes_per_s", p.bandwidth_bytes_per_s},
                                {"flops_per_s", p.flops_per_s}});
  summary["series"] = json::array();
  for (const series& s : all.series) summary["series"].push_back(series_entry(s));
  summary["points"] = json::array();
  for (const measured_point& p : all.points) summary["points"].push_back(point_entry(all, p));
  summary["speedup"] = thread_speedups(all, caveats);
  summary["algorithm_speedup"] = algorithm_speedups(all, caveats);
  summary["runtime_comparison"] = runtime_comparisons(all, caveats);
  summary["compiler_comparison"] = compiler_comparisons(all, caveats);
  summary["m_comparison"] = m_comparisons(all, caveats);
  const std::vector<ladder> ladders = ladders_of(all);
  summary["strategy_ladder"] = strategy_ladder(all, ladders);
  summary["strategy_threads"] = strategy_threads(all, ladders);
  summary["strategy_shifts"] = strategy_shifts(all, ladders);
  summary["strategies"] = strategies(summary);
  summary["self_test"] = self_tests(all, caveats);
  summary["answer"] = answer(all);
  summary["questions"] = questions(summary);
  summary["failed"] = json::array();
  for (const failed_point& f : all.failed) {
    summary["failed"].push_back({{"point", f.point}, {"study", f.study}, {"rows", f.rows}, {"error", f.error}});
    caveats.push_back(label(f.point) + ": " + std::to_string(f.rows) + (f.rows == 1 ? " row" : " rows") +
                      " without a passed verification left out");
  }
  summary["caveats"] = without_repeats(caveats);
  return summary;
}

json build_summary(const std::vector<rows_file>& files, bool allow_mixed) {
  return build_summary(collect(files, allow_mixed));
}

}  // namespace pairsum::harness

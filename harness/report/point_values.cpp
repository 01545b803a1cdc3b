// Values and names of measured points.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "harness/report/measured.hpp"
#include "harness/rows/point_words.hpp"
#include "harness/stats/median.hpp"

namespace pairsum::harness {

std::vector<double> values_of(const measured_point& point, std::optional<double> phases::*phase) {
  std::vector<double> values;
  for (const auto& entry : point.rounds)
    if (entry.second.mean.*phase) values.push_back(*(entry.second.mean.*phase));
  return values;
}

std::optional<double> median_of(const measured_point& point, std::optional<double> phases::*phase) {
  const std::vector<double> values = values_of(point, phase);
  if (values.empty() || values.size() < point.rounds.size()) return std::nullopt;
  return median(values);
}

std::optional<double> comparable_time(const measured_point& point, std::optional<double> phases::*phase) {
  const std::vector<double> values = values_of(point, phase);
  const bool positive = std::ranges::all_of(values, [](double v) { return v > 0; });
  return positive ? median_of(point, phase) : std::nullopt;
}

std::optional<double> wait_share(const measured_point& point) {
  if (!point.busy_s || !point.waiting_s) return std::nullopt;
  double busy = 0, waiting = 0;
  for (const auto& pass : *point.busy_s) busy = std::accumulate(pass.begin(), pass.end(), busy);
  for (const auto& pass : *point.waiting_s) waiting = std::accumulate(pass.begin(), pass.end(), waiting);
  return busy + waiting > 0 ? std::optional(waiting / (busy + waiting)) : std::nullopt;
}

const peak_row* peak_of(const measurements& all, const measured_point& point, int threads) {
  const peak_row* best = nullptr;
  for (const peak_row& q : all.peaks) {
    const auto build = all.build_of_environment.find(q.environment);
    if (build == all.build_of_environment.end() || build->second != all.series[point.series].build) continue;
    if (q.threads != threads || q.precision != point.point.precision) continue;
    if (best == nullptr || q.flops_per_s > best->flops_per_s) best = &q;
  }
  return best;
}

std::string label(const point& p) { return place_words(p); }

std::string label(const measurements& all, const measured_point& p) {
  if (all.series.size() < 2) return label(p.point);
  const struct point& q = p.point;
  return fmt::format("{} ({}, {}, dx {}, {}, {}, {}, {}, {}, study {})", label(q), q.case_name, q.state, q.dx, q.order,
                     q.precision, q.interaction, q.smoothing, q.integrator, all.series[p.series].study);
}

std::string first_few(const std::vector<std::string>& texts) {
  constexpr std::size_t most = 3;
  std::string list;
  for (std::size_t k = 0; k < std::min(texts.size(), most); ++k) list += (k ? ", " : "") + texts[k];
  return texts.size() > most ? fmt::format("{} and {} more", list, texts.size() - most) : list;
}

}  // namespace pairsum::harness

#include "harness/report/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/report/comparisons.hpp"
#include "harness/report/self_tests.hpp"
#include "harness/report/text_table.hpp"
#include "harness/stats/holm.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

bool may_be_taken(const measured_point& p) {
  const auto time = median_of(p, &phases::total_s);
  return time && *time > 0 && !is_self_test(p.point.backend);
}

/// Of the first build: the series of the most particles, and among these of the most points.
std::optional<std::size_t> main_series(const measurements& all) {
  std::vector<std::size_t> points(all.series.size());
  for (const measured_point& p : all.points) points[p.series] += may_be_taken(p);
  std::optional<std::size_t> best;
  const auto size = [&](std::size_t s) { return std::pair(all.series[s].common.n_fluid, points[s]); };
  for (std::size_t s = 0; s < all.series.size(); ++s)
    if (all.series[s].build == 0 && points[s] > 0 && (!best || size(s) > size(*best))) best = s;
  return best;
}

const measured_point* fastest(const std::vector<const measured_point*>& points) {
  const auto time = [](const measured_point* p) { return *median_of(*p, &phases::total_s); };
  const auto at = std::ranges::min_element(points, {}, time);
  return at == points.end() ? nullptr : *at;
}

std::string words_of(const point& p) {
  return fmt::format("{} with M = {} and {} thread{}", p.backend, p.M, p.threads, p.threads == 1 ? "" : "s");
}

struct host_words {
  std::string name, description;
};

host_words host_of(const measurements& all, const series& s) {
  for (const environment_row& e : all.environments)
    if (e.environment == s.environment) return {e.host, fmt::format("{} ({}, {} cores)", e.host, e.cpu, e.cores)};
  return {"this machine", "this machine"};
}

std::string bounds_text(const ratio_estimate& r) {
  if (!r.bounds) return fmt::format("{:.2f} times (no interval: too few rounds)", r.value);
  return fmt::format("{:.2f} times [{:.2f}, {:.2f}]", r.value, r.bounds->low, r.bounds->high);
}

/// The points that cannot be told from the best.
std::vector<const measured_point*> ties_of(const measurements& all, const measured_point& best,
                                           const std::vector<const measured_point*>& candidates,
                                           std::vector<std::string>& caveats) {
  std::vector<ratio_estimate> ratios;
  std::vector<const measured_point*> others;
  for (const measured_point* p : candidates) {
    if (p == &best) continue;
    others.push_back(p);
    ratios.push_back(ratio_of(all, *p, best, caveats, &phases::total_s));
  }
  const std::vector<ratio_verdict> verdicts = verdicts_of(ratios);
  std::vector<const measured_point*> ties;
  for (std::size_t k = 0; k < others.size(); ++k)
    if (verdicts[k] == ratio_verdict::not_resolved) ties.push_back(others[k]);
  return ties;
}

}  // namespace

json answer(const measurements& all) {
  const auto main = main_series(all);
  if (!main) return nullptr;
  std::vector<const measured_point*> candidates, naive;
  for (const measured_point& p : all.points)
    if (p.series == *main && may_be_taken(p)) candidates.push_back(&p);
  const measured_point& best = *fastest(candidates);
  for (const measured_point* p : candidates)
    if (p->point.backend.starts_with("naive") && p->point.threads == best.point.threads) naive.push_back(p);
  if (naive.empty())
    for (const measured_point* p : candidates)
      if (p->point.backend.starts_with("naive")) naive.push_back(p);
  const measured_point& base = naive.empty() ? best : *fastest(naive);
  std::vector<std::string> unsaid;  // a ratio that is not paired is said by its interval
  const ratio_estimate ratio = ratio_of(all, base, best, unsaid, &phases::total_s);
  const double time = *median_of(best, &phases::total_s), base_time = *median_of(base, &phases::total_s);
  json a;
  a["backend"] = best.point.backend;
  a["M"] = best.point.M;
  a["threads"] = best.point.threads;
  a["granularity"] = best.point.granularity;
  a["series"] = *main;
  a["time_s"] = time;
  a["base_backend"] = base.point.backend;
  a["base_M"] = base.point.M;
  a["base_threads"] = base.point.threads;
  a["base_time_s"] = base_time;
  a["speedup"] = ratio.value;
  a["low"] = ratio.bounds ? json(ratio.bounds->low) : json(nullptr);
  a["high"] = ratio.bounds ? json(ratio.bounds->high) : json(nullptr);
  a["confidence"] = ratio.bounds ? json(ratio.bounds->confidence) : json(nullptr);
  a["ties"] = json::array();
  const auto ties = ties_of(all, best, candidates, unsaid);
  std::vector<std::string> tied;
  for (const measured_point* p : ties) {
    a["ties"].push_back({{"backend", p->point.backend},
                         {"M", p->point.M},
                         {"threads", p->point.threads},
                         {"granularity", p->point.granularity}});
    tied.push_back(words_of(p->point));
  }
  const series& s = all.series[*main];
  const bool alone = &base == &best;
  a["text"] = fmt::format("On {} take {}{}.", host_of(all, s).name, words_of(best.point),
                          alone ? "" : fmt::format(": {} as fast as {}", bounds_text(ratio), words_of(base.point)));
  std::string details = fmt::format("On {} a whole step of {} fluid particles (dx {}, {}, {}, {}) takes {} ms",
                                    host_of(all, s).description, best.point.n_fluid, best.point.dx, best.point.state,
                                    best.point.precision, best.point.interaction, ms(time));
  if (!alone)
    details += fmt::format(", with {} {} ms.", words_of(base.point), ms(base_time));
  else
    details +=
        naive.empty() ? "; no naive backend was measured beside it." : ". It is the fastest naive backend itself.";
  if (!tied.empty()) details += " No difference was resolved from " + first_few(tied) + ".";
  a["details"] = details;
  return a;
}

}  // namespace pairsum::harness

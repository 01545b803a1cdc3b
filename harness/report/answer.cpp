#include "harness/report/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "harness/report/compared_points.hpp"
#include "harness/report/judged_entries.hpp"
#include "harness/report/self_tests.hpp"
#include "harness/report/text_table.hpp"
#include "harness/rows/point_words.hpp"
#include "harness/rows/variant_names.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

bool may_be_taken(const measured_point& p) {
  return comparable_time(p, &phases::total_s) && !is_self_test(p.point.backend);
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

/// Of a series, the points of the round that has the most of them: what was measured at another time, when the machine
/// may have been another one, is not compared.
std::vector<const measured_point*> together(const measurements& all, std::size_t series) {
  std::map<round_key, std::vector<const measured_point*>> rounds;
  for (const measured_point& p : all.points)
    if (p.series == series && may_be_taken(p))
      for (const auto& [round, value] : p.rounds) rounds[round].push_back(&p);
  const auto size = [](const auto& round) { return round.second.size(); };
  return std::ranges::max_element(rounds, {}, size)->second;
}

/// Points in words, among those that they are compared with.
class chosen_words {
 public:
  explicit chosen_words(const std::vector<const measured_point*>& candidates) {
    for (const measured_point* p : candidates) names_.add(p->point);
  }
  std::string operator()(const point& p) const { return choice_words(p, names_.without_grid(p)); }

 private:
  variant_names names_;
};

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

/// The fastest naive backend, if one was measured, on as many threads; else on any number.
const measured_point* naive_base(const measured_point& best, const std::vector<const measured_point*>& candidates) {
  std::vector<const measured_point*> naive, as_many_threads;
  for (const measured_point* p : candidates) {
    if (!p->point.backend.starts_with("naive")) continue;
    naive.push_back(p);
    if (p->point.threads == best.point.threads) as_many_threads.push_back(p);
  }
  return fastest(as_many_threads.empty() ? naive : as_many_threads);
}

json tie_entry(const point& p) {
  return {{"backend", p.backend},         {"grid", p.grid}, {"M", m_or_null(p)}, {"threads", p.threads},
          {"granularity", p.granularity}, {"isa", p.isa},   {"block", p.block}};
}

std::string base_text(const measured_point& best, const measured_point* base, const chosen_words& words_of) {
  if (base == nullptr) return "; no naive backend was measured beside it.";
  if (base == &best) return ". It is the fastest naive backend itself.";
  return fmt::format(", with {} {} ms.", words_of(base->point), ms(*median_of(*base, &phases::total_s)));
}

std::string ties_text(const std::vector<const measured_point*>& ties, const chosen_words& words_of) {
  std::vector<std::string> words;
  for (const measured_point* p : ties) words.push_back(words_of(p->point));
  return words.empty() ? "" : " No difference was resolved from " + first_few(words) + ".";
}

}  // namespace

json answer(const measurements& all) {
  const auto main = main_series(all);
  if (!main) return nullptr;
  const std::vector<const measured_point*> candidates = together(all, *main);
  const measured_point& best = *fastest(candidates);
  const measured_point* const naive = naive_base(best, candidates);
  const measured_point& base = naive != nullptr ? *naive : best;
  std::vector<std::string> unsaid;  // a ratio that is not paired is said by its interval
  const ratio_estimate ratio = ratio_of(all, base, best, unsaid, &phases::total_s);
  const auto ties = ties_of(all, best, candidates, unsaid);
  const double time = *median_of(best, &phases::total_s);
  const chosen_words words_of(candidates);
  json a = tie_entry(best.point);
  a["series"] = *main;
  a["time_s"] = time;
  a["base_backend"] = base.point.backend;
  a["base_grid"] = base.point.grid;
  a["base_M"] = m_or_null(base.point);
  a["base_isa"] = base.point.isa;
  a["base_block"] = base.point.block;
  a["base_threads"] = base.point.threads;
  a["base_time_s"] = *median_of(base, &phases::total_s);
  a["speedup"] = ratio.value;
  put_bounds(a, ratio.bounds);
  a["ties"] = json::array();
  for (const measured_point* p : ties) a["ties"].push_back(tie_entry(p->point));
  const host_words host = host_of(all, all.series[*main]);
  a["text"] =
      fmt::format("On {} take {}{}.", host.name, words_of(best.point),
                  &base == &best ? "" : fmt::format(": {} as fast as {}", bounds_text(ratio), words_of(base.point)));
  a["details"] =
      fmt::format("On {} a whole step of {} fluid particles (dx {}, {}, {}, {}) takes {} ms{}{}", host.description,
                  best.point.n_fluid, best.point.dx, best.point.state, best.point.precision, best.point.interaction,
                  ms(time), base_text(best, naive, words_of), ties_text(ties, words_of));
  return a;
}

}  // namespace pairsum::harness

#include "harness/run/ranking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "harness/plan/plan.hpp"

namespace pairsum::harness {
namespace {

/// Sum and number of the steps of a round.
struct steps_of_round {
  double step_s = 0, sum_s = 0, n = 0;
  std::map<int, std::uint64_t> lost;  ///< by repetition
};

std::vector<ranked> collect(const std::vector<sample>& samples, const std::map<std::string, std::string>& builds) {
  std::vector<ranked> points;
  std::vector<std::map<int, steps_of_round>> rounds;
  for (const sample& s : samples) {
    const std::string build = builds.empty() ? "" : builds.at(s.environment);
    auto at = std::ranges::find_if(points, [&](const ranked& r) { return r.what == s.point && r.build == build; });
    if (at == points.end()) {
      at = points.emplace(at);
      at->what = s.point;
      at->build = build;
      rounds.emplace_back();
    }
    if (s.error) at->error = *s.error;
    if (s.work) at->pairs = static_cast<double>(s.work->pairs_interacting);
    if (!s.phases || !(s.phases->total_s.value_or(0) > 0)) continue;
    steps_of_round& r = rounds[static_cast<std::size_t>(at - points.begin())][s.round];
    r.step_s += *s.phases->total_s;
    r.sum_s += s.phases->sum_s.value_or(0);
    ++r.n;
    r.lost[s.repetition] += s.lost.value_or(0);
  }
  for (std::size_t k = 0; k < points.size(); ++k)
    for (const auto& [round, r] : rounds[k]) {
      points[k].step_s[round] = r.step_s / r.n;
      points[k].sum_s[round] = r.sum_s / r.n;
      for (const auto& [repetition, lost] : r.lost) points[k].lost = std::max(points[k].lost, lost);
      if (points[k].lost > 0) points[k].pairs = 0;
    }
  return points;
}

double geometric_mean(const std::map<int, double>& by_round) {
  double sum = 0;
  for (const auto& [round, seconds] : by_round) sum += std::log(seconds);
  return std::exp(sum / static_cast<double>(by_round.size()));
}

/// The paired ratio of two points' steps.
ratio_estimate ratio_of(const ranked& own, const ranked& fastest) {
  std::vector<double> own_s, fastest_s;
  for (const auto& [round, seconds] : own.step_s)
    if (const auto match = fastest.step_s.find(round); match != fastest.step_s.end()) {
      own_s.push_back(seconds);
      fastest_s.push_back(match->second);
    }
  if (!own_s.empty()) return paired_ratio(own_s, fastest_s);
  return {geometric_mean(own.step_s) / geometric_mean(fastest.step_s), {}, 0, {}};
}

void compare(ranking& points) {
  const auto key = [](const ranked& r) {
    return r.has_rank() ? std::pair(0, geometric_mean(r.step_s)) : std::pair(1, 0.0);
  };
  std::ranges::stable_sort(points, {}, key);
  std::vector<ratio_estimate> ratios;
  for (std::size_t k = 1; k < points.size() && points[k].has_rank(); ++k)
    ratios.push_back(points[k].ratio = ratio_of(points[k], points.front()));
  const std::vector<ratio_verdict> verdicts = verdicts_of(ratios);  // the fastest against each as a base
  for (std::size_t k = 0; k < verdicts.size(); ++k) points[k + 1].is_slower = verdicts[k] == ratio_verdict::faster;
}

}  // namespace

std::string problem_words(const point& p) {
  return fmt::format("{} {}D, dx {:g}, {}, H = {:.3g} dx, {}, {}, {}, order {}", p.case_name, p.dim, p.dx, p.state,
                     p.H / p.dx, p.interaction, p.smoothing, p.integrator, p.order) +
         (p.dt == run_request{}.dt ? "" : fmt::format(", dt {:g}", p.dt));
}

std::vector<ranking> rank(const std::vector<sample>& samples, const std::map<std::string, std::string>& builds) {
  std::vector<ranking> all;
  for (ranked& r : collect(samples, builds)) {
    const auto at = std::ranges::find_if(
        all, [&](const ranking& other) { return problem_words(other.front().what) == problem_words(r.what); });
    (at == all.end() ? all.emplace_back() : *at).push_back(std::move(r));
  }
  for (ranking& points : all) compare(points);
  const auto key = [](const ranking& r) {
    const point& p = r.front().what;
    return std::pair(-static_cast<double>(p.n_fluid + p.n_boundary), problem_words(p));
  };
  std::ranges::sort(all, {}, key);
  return all;
}

std::map<std::string, std::string> build_words(const std::vector<environment_row>& environments) {
  using member = std::string environment_row::*;
  for (const member word :
       {&environment_row::compiler, &environment_row::git, &environment_row::flags, &environment_row::environment}) {
    std::map<std::string, std::string> words;
    std::set<std::string> different;
    for (const environment_row& e : environments) different.insert(words[e.environment] = e.*word);
    if (different.size() == words.size()) return words;
  }
  return {};
}

}  // namespace pairsum::harness

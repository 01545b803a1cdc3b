#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "harness/report/judged_entries.hpp"
#include "harness/report/strategies.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

double reach(const series& s) { return s.common.H / s.common.dx; }

bool same_reach(const series& a, const series& b) { return std::abs(reach(a) - reach(b)) < 0.005 * reach(b); }

/// Is all that is no place the same: study, build, formula?
bool alike(const series& a, const series& b) {
  const auto words = [](const series& s) {
    const point& p = s.common;
    return std::tie(s.study, s.build, p.state, p.order, p.precision, p.interaction, p.smoothing, p.integrator, p.dt);
  };
  return words(a) == words(b);
}

/// In what `here` differs from `there`, the usual one of the two; empty if they are not to be compared.
std::string difference(const series& here, const series& there) {
  constexpr const char* usual_case = "dam_break";
  const point &a = here.common, &b = there.common;
  if (!alike(here, there)) return "";
  if (a.case_name == b.case_name && a.dim == b.dim && a.dx == b.dx && reach(here) < 0.9 * reach(there))
    return "sparsity";
  if (a.case_name == b.case_name && a.dim < 3 && b.dim == 3 && same_reach(here, there)) return "dimension";
  if (a.case_name != usual_case && b.case_name == usual_case && a.dim == b.dim) return "case";
  return "";
}

/// The ladder of the most threads of its series.
bool is_highest(const ladder& l, const std::vector<ladder>& all) {
  return l.at == "most_threads" || std::ranges::none_of(all, [&](const ladder& other) {
           return other.series == l.series && other.at == "most_threads";
         });
}

struct contrast {
  const ladder* there = nullptr;
  std::string what;
};

/// What a ladder is compared with: one that differs in sparsity, or else in dimension, or else in the case; of several
/// the one with the most particles.
contrast contrast_of(const measurements& all, const ladder& here, const std::vector<ladder>& ladders) {
  contrast best;
  for (const char* what : {"sparsity", "dimension", "case"}) {
    for (const ladder& there : ladders) {
      if (there.at != here.at || there.base_rung().p->point.backend != here.base_rung().p->point.backend) continue;
      if (difference(all.series[here.series], all.series[there.series]) != what) continue;
      const auto size = [&](const ladder& l) { return all.series[l.series].common.n_fluid; };
      if (best.there == nullptr || size(there) > size(*best.there)) best = {&there, what};
    }
    if (best.there != nullptr) return best;
  }
  return best;
}

}  // namespace

json strategy_shifts(const measurements& all, const std::vector<ladder>& ladders) {
  judged_entries entries;
  for (const ladder& here : ladders) {
    if (!is_highest(here, ladders)) continue;
    const auto [there, what] = contrast_of(all, here, ladders);
    if (there == nullptr) continue;
    for (std::size_t k = 0; k < here.rungs.size(); ++k) {
      const rung& own = here.rungs[k];
      const auto place = there->place_of(own.p->point.backend);
      if (k == here.base || !place) continue;
      const round_values now = standing(own.times, here.base_rung().times),
                         before = standing(there->rungs[*place].times, there->base_rung().times);
      if (now.empty() || before.empty()) continue;
      json entry{{"series", here.series},
                 {"world", world_words(all, here.series)},
                 {"base_series", there->series},
                 {"base_world", world_words(all, there->series)},
                 {"what", what},
                 {"backend", own.p->point.backend},
                 {"threads", own.p->point.threads},
                 {"base_backend", here.base_rung().p->point.backend},
                 {"rank", k + 1},
                 {"of", here.rungs.size()},
                 {"base_rank", *place + 1},
                 {"base_of", there->rungs.size()}};
      const ratio_estimate ratio = unpaired_ratio_of(before, now);
      entry["ratio"] = ratio.value;
      put_bounds(entry, ratio.bounds);
      entry["rounds"] = now.size();
      entry["base_rounds"] = before.size();
      entries.add(std::move(entry), ratio);
    }
  }
  return std::move(entries).judged();
}

}  // namespace pairsum::harness

#include "harness/tune/ladder.hpp"

#include <algorithm>
#include <utility>

#include "harness/stats/holm.hpp"
#include "harness/tune/paired_times.hpp"

namespace pairsum::harness {

std::string_view word_of(standing_of s) {
  constexpr std::string_view words[]{"slower", "faster", "not resolved", "set aside"};
  return words[static_cast<unsigned>(s)];
}

std::vector<rung> ladder_of(const tune_result& result) {
  const contestant& best = result.candidates[result.winner.value()];
  std::vector<rung> rungs;
  for (std::size_t k = 0; k < result.candidates.size(); ++k) {
    const contestant& c = result.candidates[k];
    if (k == *result.winner || !c.look_s || c.what == fate::wrong) continue;
    rung one{k, ratio_to(c, best), standing_of::set_aside};
    if (one.ratio.pairs == 0) one.ratio.value = *c.look_s / *best.look_s;
    rungs.push_back(one);
  }
  std::ranges::stable_sort(rungs, {}, [](const rung& r) { return std::pair(r.ratio.pairs == 0, r.ratio.value); });
  std::vector<ratio_estimate> ratios;
  for (const rung& r : rungs) ratios.push_back(r.ratio);
  const std::vector<ratio_verdict> verdicts = verdicts_of(ratios);
  // Base and other change places here: the ratio is the candidate's time over the winner's.
  for (std::size_t k = 0; k < rungs.size(); ++k)
    if (rungs[k].ratio.pairs > 0)
      rungs[k].verdict = verdicts[k] == ratio_verdict::faster   ? standing_of::slower
                         : verdicts[k] == ratio_verdict::slower ? standing_of::faster
                                                                : standing_of::not_resolved;
  return rungs;
}

}  // namespace pairsum::harness

#include "harness/tune/tune_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/measure/cpu_time.hpp"
#include "harness/rows/point_words.hpp"
#include "harness/terminal/terminal.hpp"
#include "harness/tune/candidates.hpp"
#include "harness/tune/ladder.hpp"
#include "harness/tune/winner.hpp"

namespace pairsum::harness {
namespace {

constexpr std::size_t most_looks_shown = 8;    ///< of those that got no rounds
constexpr std::size_t most_rounds_shown = 12;  ///< of those that got some

std::string count_of(std::size_t n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

std::string what_of(const point& p, const registry& all) {
  return place_words(p) + (says_isa(p, all) ? " " + p.isa : "") + " " + p.precision;
}

std::string interval_text(const ratio_estimate& r) {
  return r.bounds ? fmt::format("[{:.3f}, {:.3f}]", r.bounds->low, r.bounds->high) : "-";
}

std::string verdict_text(const rung& r, const contestant& c, bool colours) {
  if (r.verdict == standing_of::set_aside) return "set aside after its looks";
  const tone how = r.verdict == standing_of::slower ? tone::good : tone::doubtful;
  return coloured(how, word_of(r.verdict), colours) + (c.what == fate::halved ? " (set aside then)" : "");
}

std::string ladder_text(const tune_result& result, const registry& all, bool colours) {
  const std::vector<rung> rungs = ladder_of(result);
  if (rungs.empty()) return "";
  std::size_t width = 9;
  for (const rung& r : rungs) width = std::max(width, what_of(result.points[r.candidate], all).size());
  std::string text = "its time over the winner's:\n";
  text += fmt::format("{:<{}}{:>10}  {:<16}{:>7}  {}\n", "candidate", width, "ratio", "[low, high]", "rounds", "it is");
  std::size_t looked_at = 0, in_rounds = 0;
  for (const rung& r : rungs) {
    const contestant& c = result.candidates[r.candidate];
    if (r.ratio.pairs == 0 ? ++looked_at > most_looks_shown : ++in_rounds > most_rounds_shown) continue;
    text += fmt::format("{:<{}}{:>10.3f}  {:<16}{:>7}  {}\n", what_of(result.points[r.candidate], all), width,
                        r.ratio.value, interval_text(r.ratio), c.times.size(), verdict_text(r, c, colours));
  }
  if (in_rounds > most_rounds_shown)
    text += fmt::format("and {} more, measured in rounds (all of them: --json)\n", in_rounds - most_rounds_shown);
  if (looked_at > most_looks_shown)
    text += fmt::format("and {} more, set aside after their looks\n", looked_at - most_looks_shown);
  return text;
}

std::string listed(const tune_result& result, fate what, const registry& all) {
  std::string text;
  std::size_t n = 0;
  for (std::size_t k = 0; k < result.candidates.size(); ++k) {
    if (result.candidates[k].what != what) continue;
    if (++n <= 4) text += (text.empty() ? "" : ", ") + what_of(result.points[k], all);
  }
  return n > 4 ? fmt::format("{} and {} more", text, n - 4) : text;
}

std::string left_out_text(const tune_result& result, const registry& all, bool colours) {
  std::string text;
  const auto add = [&](fate what, const char* why) {
    const auto n = static_cast<std::size_t>(std::ranges::count(result.candidates, what, &contestant::what));
    if (n > 0) text += fmt::format("{} {}: {}\n", count_of(n, "candidate"), why, listed(result, what, all));
  };
  add(fate::not_seen, "not measured, the time was up");
  add(fate::passed_by, "not measured, others of the same backend took more than twice as long as the fastest");
  for (std::size_t k = 0; k < result.candidates.size(); ++k)
    if (result.candidates[k].what == fate::wrong)
      text += fmt::format("{} {} its verification: {}\n", what_of(result.points[k], all),
                          coloured(tone::bad, "FAILED", colours), result.candidates[k].error);
  return text;
}

}  // namespace

std::string tune_text(const tune_request& r, const tune_result& result, const registry& all, bool colours) {
  if (!result.winner) return left_out_text(result, all, colours) + "no candidate was measured to an end\n";
  const point& best = result.points[*result.winner];
  const tuned_time time = time_of(result);
  const std::string text = fmt::format(
      "{} of {} fluid and {} boundary particles: take {}\n{} ms {}{}\n\n",
      r.phase == "sum" ? "the sum" : "a whole step", best.n_fluid, best.n_boundary,
      coloured(tone::strong, what_of(best, all), colours), fmt::format("{:.4g}", 1e3 * time.seconds),
      r.phase == "sum" ? "a sum" : "a step",
      time.bounds
          ? fmt::format(" [{:.4g}, {:.4g}], {}", 1e3 * time.bounds->low, 1e3 * time.bounds->high,
                        count_of(time.rounds, "round"))
          : fmt::format(" (no interval: {})", time.rounds == 0 ? "looks alone" : count_of(time.rounds, "round")));
  return text + ladder_text(result, all, colours) + left_out_text(result, all, colours) +
         (result.others_share.value_or(0) > disturbing_share
              ? coloured(tone::doubtful, "disturbed", colours) +
                    fmt::format(": other processes used {:.0f} % of the machine meanwhile; close them and tune again\n",
                                100 * *result.others_share)
              : "");
}

}  // namespace pairsum::harness

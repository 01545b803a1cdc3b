#include "harness/tune/tune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include "harness/environment/machine.hpp"
#include "harness/measure/cpu_time.hpp"
#include "harness/measure/memory.hpp"
#include "harness/measure/stopwatch.hpp"
#include "harness/rows/point_words.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/progress.hpp"
#include "harness/tune/bench.hpp"
#include "harness/tune/candidates.hpp"

namespace pairsum::harness {
namespace {

void check(const tune_request& r, const registry& all) {
  check_request(r.levels, all);
  if (!(r.budget_s > 0) || !std::isfinite(r.budget_s))
    throw error(fmt::format("budget must be a positive number of seconds, is {}", r.budget_s));
  check_word("phase", r.phase, std::vector<std::string_view>{"total", "sum"});
}

bool any_seen(const std::vector<contestant>& all) {
  return std::ranges::any_of(all, [](const contestant& c) { return c.what != fate::not_seen; });
}

}  // namespace

tune_result tune(const tune_request& r, const registry& all) {
  check(r, all);
  const stopwatch since_start;
  progress line(r.budget_s, r.budget_s);
  const auto show = [&](const std::string& text) { line.show(since_start.seconds(), text); };
  tune_result result;
  result.points = candidates_of(r.levels, all);
  if (numa_nodes() == 1) keep_freed_memory();
  show("making the particles");
  tune_bench bench(r, result.points.front(), all);
  bench.leave_out_wide_skins(result.points);
  if (!r.all_M) bench.leave_out_M_that_do_not_fit(result.points);
  bench.check_input(result.points.front());
  for (const point& p : result.points) result.candidates.emplace_back().family = family_of(p);
  for (point& p : result.points) bench.complete(p);
  if (!interrupted()) {
    show("making the reference");
    bench.make_reference(result.points.front());
  }
  result.prepared_s = since_start.seconds();
  const auto machine_before = machine_time_now();
  const double own_before = own_time();
  contest_world world;
  world.measure = [&](std::size_t k, std::string& why) { return bench.measure(result.points[k], why); };
  world.left_s = [&] { return r.budget_s - since_start.seconds(); };
  world.interrupted = [] { return interrupted(); };
  world.show = show;
  if (world.left_s() > 0 && !interrupted()) contend(result.candidates, r.rules, world);
  result.others_share = share_of_others(machine_before, machine_time_now(), own_time() - own_before);
  line.clear();
  result.interrupted = interrupted();
  if (!any_seen(result.candidates) && !result.interrupted)
    throw error(
        fmt::format("the budget of {:g} s went by with particles and reference ({:.1f} s): none of the {} "
                    "candidates was measured; try --budget {:.0f}",
                    r.budget_s, result.prepared_s, result.points.size(), std::ceil(3 * result.prepared_s + 1)));
  result.winner = winner_of(result.candidates);
  return result;
}

}  // namespace pairsum::harness

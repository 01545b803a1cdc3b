#include "harness/run/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include <pairsum/sum/grids.hpp>
#include "harness/evolve/evolved.hpp"
#include "harness/plan/levels.hpp"
#include "harness/plan/words.hpp"
#include "harness/run/estimate.hpp"
#include "harness/terminal/program.hpp"

namespace pairsum::harness {
namespace {

std::string text_of(const nlohmann::json& value) {
  if (!value.is_array()) return value.is_string() ? value.get<std::string>() : value.dump();
  std::string text;
  for (const auto& v : value) text += (text.empty() ? "" : ", ") + text_of(v);
  return text;
}

std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string rounds_of(const part_plan& p) {
  if (p.least_rounds == p.most_rounds) return fmt::format("{} round{}", p.most_rounds, p.most_rounds == 1 ? "" : "s");
  return fmt::format(
      "{} to {} rounds{}", p.least_rounds, p.most_rounds,
      p.half_width > 0 ? fmt::format(", until every interval is within +-{:g} %", 100 * p.half_width) : "");
}

/// The levels that nearly every plan says, and those that are not at their defaults.
std::string levels_text(const run_request& r) {
  const nlohmann::json standard = levels_json(run_request{}), levels = levels_json(r);
  std::string text;
  for (const auto& item : levels.items()) {
    const bool always = item.key() == "backend" || item.key() == "dx" || item.key() == "M" || item.key() == "threads" ||
                        item.key() == "state";
    if (item.key() == "M" && std::ranges::none_of(r.grids, grid_takes_M)) continue;
    if (always || item.value() != standard.value(item.key(), nlohmann::json()))
      text += fmt::format("  {:<14}{}\n", item.key(), text_of(item.value()));
  }
  return text;
}

/// What has to be stepped to before anything is measured.
std::string evolved_states_text(const study_plan& plan) {
  std::set<std::string> evolved;
  for (const part_plan& part : plan.parts)
    for (const std::string& state : part.request.states)
      if (evolved_time(state)) evolved.insert(state);
  if (evolved.empty()) return "";
  return fmt::format("\nmade before, which takes minutes, unless kept in {}: {}\n", one_line(cache_folder().string()),
                     fmt::join(evolved, ", "));
}

}  // namespace

std::string dry_run(const study_plan& plan, const registry& all) {
  const plan_here here = measurable(plan, all);
  estimate time(here.plan, all);
  if (!here.plan.parts.empty()) time.calibrate(all);
  std::string text = fmt::format("study {}: {}\n", plan.study, plan.title);
  if (plan.builds > 1) text += fmt::format("compares {} builds: this program and what --program names\n", plan.builds);
  if (plan.peaks && !here.plan.parts.empty())
    text += fmt::format("\npeaks: bandwidth and multiply-adds of the machine, about {}\n", duration(time.peaks_s()));
  text += evolved_states_text(here.plan);
  std::size_t k = 0;  // among the parts that can be measured
  double unlimited = time.peaks_s();
  for (const part_plan& part : plan.parts) {
    const std::string& name = part.request.part;
    const bool whole = k == here.plan.parts.size() || here.plan.parts[k].request.part != name;
    if (whole)
      text += fmt::format("\npart {}: nothing of it can be measured here\n", name);
    else
      text += fmt::format("\npart {}: {} point{}, {}; a round takes about {}, verifying it before about {}\n", name,
                          time.points(k), time.points(k) == 1 ? "" : "s", rounds_of(part), duration(time.round_s(k)),
                          duration(time.verify_s(k)));
    if (!part.reason.empty()) text += "  because: " + part.reason + "\n";
    text += levels_text(part.request);
    if (const auto why = here.left_out.find(name); why != here.left_out.end())
      for (const std::string& line : why->second) text += "  left out: " + line + "\n";
    if (whole) continue;
    unlimited += time.verify_s(k) + part.least_rounds * time.round_s(k);
    ++k;
  }
  if (!here.left_out.empty())
    text += fmt::format("\n{} of {} parts cannot be measured as they are by this build on this machine\n",
                        here.left_out.size(), plan.parts.size());
  if (here.plan.parts.empty()) return text;
  text += fmt::format("\nabout {} for the least rounds of every part", duration(unlimited));
  if (plan.budget_s > 0)
    text += fmt::format("; the budget is {}{}", duration(plan.budget_s),
                        unlimited > plan.budget_s ? ": parts get fewer rounds, or --budget gives more" : "");
  return text + "\n";
}

}  // namespace pairsum::harness

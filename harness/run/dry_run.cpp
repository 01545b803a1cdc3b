#include "harness/run/dry_run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "harness/plan/levels.hpp"
#include "harness/run/estimate.hpp"

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

}  // namespace

std::string dry_run(const study_plan& plan, const registry& all) {
  estimate time(plan, all);
  time.calibrate(all);
  std::string text = fmt::format("study {}: {}\n", plan.study, plan.title);
  if (plan.peaks)
    text += fmt::format("\npeaks: bandwidth and multiply-adds of the machine, about {}\n", duration(time.peaks_s()));
  const nlohmann::json standard = levels_json(run_request{});
  for (std::size_t k = 0; k < plan.parts.size(); ++k) {
    const part_plan& part = plan.parts[k];
    text += fmt::format("\npart {}: {} point{}, {}; a round takes about {}, verifying it before about {}\n",
                        part.request.part, time.points(k), time.points(k) == 1 ? "" : "s", rounds_of(part),
                        duration(time.round_s(k)), duration(time.verify_s(k)));
    if (!part.reason.empty()) text += "  because: " + part.reason + "\n";
    const nlohmann::json levels = levels_json(part.request);  // items() does not keep it
    for (const auto& item : levels.items()) {
      const bool always = item.key() == "backend" || item.key() == "dx" || item.key() == "M" ||
                          item.key() == "threads" || item.key() == "state";
      if (always || item.value() != standard.at(item.key()))
        text += fmt::format("  {:<14}{}\n", item.key(), text_of(item.value()));
    }
  }
  double unlimited = time.peaks_s();
  for (std::size_t k = 0; k < plan.parts.size(); ++k)
    unlimited += time.verify_s(k) + plan.parts[k].least_rounds * time.round_s(k);
  text += fmt::format("\nabout {} for the least rounds of every part", duration(unlimited));
  if (plan.budget_s > 0)
    text += fmt::format("; the budget is {}{}", duration(plan.budget_s),
                        unlimited > plan.budget_s ? ": parts get fewer rounds, or --budget gives more" : "");
  return text + "\n";
}

}  // namespace pairsum::harness

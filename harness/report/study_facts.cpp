#include "harness/report/study_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "harness/stats/moments.hpp"

namespace pairsum::harness {
namespace {

/// Above this share of the machine's time used by others, a round counts as disturbed.
constexpr double disturbing_share = 0.05;

/// The peak of the same environment, threads and precision; nullptr if none is known.
template <class Row>
peak_row* peak_like(measurements& all, const Row& p) {
  const auto like = std::ranges::find_if(all.peaks, [&](const peak_row& known) {
    return known.environment == p.environment && known.threads == p.threads && known.precision == p.precision;
  });
  return like == all.peaks.end() ? nullptr : &*like;
}

}  // namespace

void add_peak(measurements& all, const peak_row& p) {
  peak_row* const known = peak_like(all, p);
  if (known == nullptr) {
    all.peaks.push_back(p);
    return;
  }
  known->bandwidth_bytes_per_s = std::max(known->bandwidth_bytes_per_s, p.bandwidth_bytes_per_s);
  known->flops_per_s = std::max(known->flops_per_s, p.flops_per_s);
}

void add_paces(measurements& all, const rows_file& rows, std::size_t file) {
  std::map<pace_key, std::vector<double>> found;
  for (const pace_row& p : rows.valid_paces()) {
    const auto build = all.build_of_environment.find(p.environment);
    if (build == all.build_of_environment.end()) continue;
    found[{{file, p.round}, p.study, build->second, p.threads, p.precision}].push_back(p.flops_per_s);
    if (peak_row* const known = peak_like(all, p)) known->flops_per_s = std::max(known->flops_per_s, p.flops_per_s);
  }
  for (const auto& [key, values] : found) all.paces[key] = mean(values);
}

void add_rounds(measurements& all, const rows_file& file) {
  std::size_t disturbed = 0;
  for (const round_row& r : file.finished_rounds()) {
    ++all.finished_rounds;
    if (!r.others_share) continue;
    all.others_share = std::max(all.others_share.value_or(0), *r.others_share);
    disturbed += *r.others_share > disturbing_share;
  }
  all.void_rounds += file.voids.size();
  if (disturbed > 0)
    all.caveats.push_back(fmt::format("{}: in {} of {} rounds other processes used more than {:.0f} % of the machine",
                                      file.path.filename().string(), disturbed, file.finished_rounds().size(),
                                      100 * disturbing_share));
}

void add_environment_caveats(measurements& all, const std::string& differences) {
  if (!differences.empty())
    all.caveats.push_back((all.compares_builds ? "the builds differ, which is what is compared: "
                                               : "rows of different machines or builds in one report: ") +
                          differences);
  std::set<std::string> governors;
  bool dirty = false;
  for (const environment_row& e : all.environments) {
    governors.insert(e.governor.value_or("unknown"));
    dirty = dirty || e.dirty;
  }
  if (dirty) all.caveats.push_back("built from a tree with uncommitted changes");
  for (const environment_row& e : all.environments)
    if (e.binding.starts_with("none")) {
      all.caveats.push_back("threads were not pinned (" + e.binding + ")");
      break;
    }
  if (governors.size() > 1) all.caveats.push_back("rows with different frequency governors");
}

}  // namespace pairsum::harness

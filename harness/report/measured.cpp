#include "harness/report/measured.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include <pairsum/core/error.hpp>
#include <pairsum/core/isa.hpp>
#include "harness/report/builds.hpp"
#include "harness/report/compared_points.hpp"
#include "harness/report/step_means.hpp"
#include "harness/report/study_facts.hpp"

namespace pairsum::harness {
namespace {

auto order_of(const point& p) {
  return std::tie(p.case_name, p.state, p.dx, p.H, p.n_fluid, p.n_boundary, p.order, p.dim, p.precision, p.interaction,
                  p.smoothing, p.integrator, p.dt, p.backend, p.grid, p.isa, p.block, p.granularity, p.M, p.threads);
}

struct point_less {
  bool operator()(const point& a, const point& b) const { return order_of(a) < order_of(b); }
};

struct group_key {
  std::string study;
  std::size_t build;
  std::optional<std::uint64_t> seed;  ///< if the particles depend on it
  struct point point;
  bool operator<(const group_key& other) const {
    return std::tie(study, build, seed) != std::tie(other.study, other.build, other.seed)
               ? std::tie(study, build, seed) < std::tie(other.study, other.build, other.seed)
               : point_less()(point, other.point);
  }
};

struct group {
  std::map<round_key, std::map<int, std::vector<sample>>> rounds;  ///< by repetition
  int cores = 1;
};

/// Another seed makes other particles, or another order of them, unless the case is at rest and in order.
std::optional<std::uint64_t> seed_of(const sample& s) {
  const bool same = s.point.state == "rest" && s.point.order != "shuffled" && !s.point.case_name.starts_with("random");
  return same ? std::nullopt : std::optional(s.seed);
}

/// Points that were summed one pair at a time, whatever isa their rows name: rows used to name that of the build. Work
/// stands in the first row of a repetition.
std::set<point, point_less> scalar_points(const std::vector<sample>& samples) {
  std::set<point, point_less> scalar;
  for (const sample& s : samples)
    if (s.work && (!s.work->vector_units || s.work->vector_units->lanes == 1)) scalar.insert(s.point);
  return scalar;
}

bool verified(const sample& s) { return !s.error && s.phases && s.verify.fingerprint; }

std::size_t series_of(measurements& all, const group_key& key, const builds& known) {
  point common = key.point;
  common.backend.clear();
  common.grid.clear();
  common.granularity.clear();
  common.isa.clear();
  common.block.clear();
  common.M = 0;
  common.threads = 0;
  for (std::size_t i = 0; i < all.series.size(); ++i) {
    const series& s = all.series[i];
    if (s.study == key.study && s.build == key.build && s.seed == key.seed && s.common == common) return i;
  }
  all.series.push_back(
      {key.study, key.build, known.first(key.build).environment, build_name(known.first(key.build)), key.seed, common});
  return all.series.size() - 1;
}

/// The value of a point in a round; empty, with the reason in `failed`, if a row of it is not verified.
std::optional<round_value> value_of(std::map<int, std::vector<sample>>& repetitions, failed_point& failed) {
  round_value value;
  std::size_t unverified = 0;
  for (auto& entry : repetitions) {
    std::vector<sample>& steps = entry.second;
    std::sort(steps.begin(), steps.end(), [](const sample& a, const sample& b) { return a.step < b.step; });
    std::vector<phases> times;
    for (const sample& s : steps) {
      if (verified(s)) {
        times.push_back(*s.phases);
        continue;
      }
      ++unverified;
      if (failed.error.empty()) failed.error = s.error.value_or("not verified");
    }
    if (!times.empty()) value.repetitions.push_back(mean_of(times));
  }
  failed.rows += unverified;
  if (unverified > 0 || value.repetitions.empty()) return std::nullopt;
  value.mean = mean_of(value.repetitions);
  return value;
}

void raise(std::optional<std::uint64_t>& most, const std::optional<std::uint64_t>& value) {
  if (value) most = std::max(most.value_or(0), *value);
}

void add_group(measurements& all, const group_key& key, group& g, const builds& known) {
  failed_point failed{key.point, key.study, 0, ""};
  measured_point measured;
  std::set<std::size_t> step_counts;
  step_means means;
  for (auto& [round, repetitions] : g.rounds) {
    auto value = value_of(repetitions, failed);
    if (!value) continue;
    measured.rounds[round] = std::move(*value);
    measured.repetitions = std::max(measured.repetitions, repetitions.size());
    for (const auto& [repetition, steps] : repetitions) {
      if (measured.fingerprint.empty()) measured.fingerprint = *steps.front().verify.fingerprint;
      step_counts.insert(steps.size());
      for (const sample& s : steps) {
        means.add(s);
        if (!measured.work) measured.work = s.work;
        raise(measured.peak_rss_bytes, s.peak_rss_bytes);
        raise(measured.workspace_bytes, s.workspace_bytes);
      }
    }
  }
  if (failed.rows > 0) all.failed.push_back(failed);
  if (measured.rounds.empty()) return;
  means.put(measured);
  measured.point = key.point;
  measured.series = series_of(all, key, known);
  measured.cores = g.cores;
  measured.steps = *step_counts.rbegin();
  if (step_counts.size() > 1)
    all.caveats.push_back(label(key.point) + ": its repetitions have " + std::to_string(*step_counts.begin()) + " to " +
                          std::to_string(*step_counts.rbegin()) + " steps");
  all.points.push_back(std::move(measured));
}

}  // namespace

measurements collect(const std::vector<rows_file>& files, bool allow_mixed) {
  measurements all;
  builds known;
  std::map<group_key, group> groups;
  std::set<std::string> listed;
  for (std::size_t file = 0; file < files.size(); ++file) {
    all.sources.push_back((files[file].path.parent_path().filename() / files[file].path.filename()).generic_string());
    std::map<std::string, const environment_row*> environments;
    for (const environment_row& e : files[file].environments) environments[e.environment] = &e;
    add_rounds(all, files[file]);
    std::map<std::pair<std::string, int>, std::set<std::size_t>> builds_of_round;
    const std::vector<sample> samples = files[file].valid_samples();
    const std::set<point, point_less> scalar = scalar_points(samples);
    for (const sample& s : samples) {
      const environment_row& e = *environments.at(s.environment);
      if (listed.insert(e.environment + e.host + e.git).second) all.environments.push_back(e);
      const std::size_t build = known.add(e);
      all.build_of_environment[e.environment] = build;
      builds_of_round[{s.study, s.round}].insert(build);
      point measured = s.point;
      if (scalar.contains(measured)) measured.isa = scalar_isa;
      group& g = groups[{s.study, build, seed_of(s), std::move(measured)}];
      g.cores = e.cores;
      g.rounds[{file, s.round}][s.repetition].push_back(s);
    }
    for (const auto& [round, together] : builds_of_round) known.measured_together(together);
  }
  for (const rows_file& file : files)
    for (const peak_row& p : file.peaks) add_peak(all, p);
  for (std::size_t file = 0; file < files.size(); ++file) add_paces(all, files[file], file);
  const std::string differences = known.differences();
  all.compares_builds = known.are_a_factor();
  if (!differences.empty() && !all.compares_builds && !allow_mixed)
    throw error("the rows come from different machines or builds: " + differences +
                "; report them apart, or with --allow-mixed as series of their own");
  add_environment_caveats(all, differences);
  for (auto& entry : groups) add_group(all, entry.first, entry.second, known);
  return all;
}

}  // namespace pairsum::harness

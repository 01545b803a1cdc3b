#include "harness/report/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "harness/report/builds.hpp"
#include "harness/stats/median.hpp"

namespace pairsum::harness {
namespace {

auto order_of(const point& p) {
  return std::tie(p.case_name, p.state, p.dx, p.H, p.n_fluid, p.n_boundary, p.order, p.dim, p.precision, p.interaction,
                  p.smoothing, p.integrator, p.dt, p.isa, p.backend, p.grid, p.granularity, p.M, p.threads);
}

struct point_less {
  bool operator()(const point& a, const point& b) const { return order_of(a) < order_of(b); }
};

struct group_key {
  std::string study;
  std::size_t build;
  struct point point;
  bool operator<(const group_key& other) const {
    return std::tie(study, build) != std::tie(other.study, other.build)
               ? std::tie(study, build) < std::tie(other.study, other.build)
               : point_less()(point, other.point);
  }
};

struct group {
  std::map<round_key, std::map<int, std::vector<sample>>> rounds;  ///< by repetition
  int cores = 1;
};

bool verified(const sample& s) { return !s.error && s.phases && s.verify.fingerprint; }

void add_to(thread_times& sum, const thread_times& more) {
  sum.resize(std::max(sum.size(), more.size()));
  for (std::size_t pass = 0; pass < more.size(); ++pass) {
    sum[pass].resize(std::max(sum[pass].size(), more[pass].size()));
    for (std::size_t k = 0; k < more[pass].size(); ++k) sum[pass][k] += more[pass][k];
  }
}

/// Means over all timed steps, of what only some rows have.
class step_means {
 public:
  void add(const sample& s) {
    if (s.threads_busy_s && s.barrier_wait_s) {
      add_to(busy_, *s.threads_busy_s);
      add_to(waiting_, *s.barrier_wait_s);
      ++timed_;
    }
    if (s.counters) {
      add(cycles_, s.counters->cycles);
      add(instructions_, s.counters->instructions);
      add(misses_, s.counters->cache_misses);
      ++counted_;
    }
  }

  void put(measured_point& p) const {
    if (timed_ > 0) {
      p.busy_s = scaled(busy_);
      p.waiting_s = scaled(waiting_);
    }
    if (counted_ > 0) p.counters = counters_row{mean(cycles_), mean(instructions_), mean(misses_)};
  }

 private:
  static void add(std::optional<std::uint64_t>& sum, const std::optional<std::uint64_t>& more) {
    if (more) sum = sum.value_or(0) + *more;
  }
  std::optional<std::uint64_t> mean(const std::optional<std::uint64_t>& sum) const {
    return sum ? std::optional(*sum / counted_) : std::nullopt;
  }
  thread_times scaled(thread_times t) const {
    for (auto& pass : t)
      for (double& s : pass) s /= static_cast<double>(timed_);
    return t;
  }
  thread_times busy_, waiting_;
  std::size_t timed_ = 0;
  std::uint64_t counted_ = 0;
  std::optional<std::uint64_t> cycles_, instructions_, misses_;
};

phases mean_of(const std::vector<phases>& all) {
  phases mean;
  for (const phase_member& phase : phase_members) {
    double sum = 0;
    std::size_t timed = 0;
    for (const phases& p : all) {
      sum += (p.*phase.value).value_or(0);
      timed += (p.*phase.value).has_value();
    }
    if (timed == all.size()) mean.*phase.value = sum / static_cast<double>(timed);
  }
  return mean;
}

std::size_t series_of(measurements& all, const group_key& key, const builds& known) {
  point common = key.point;
  common.backend.clear();
  common.grid.clear();
  common.granularity.clear();
  common.M = 0;
  common.threads = 0;
  for (std::size_t i = 0; i < all.series.size(); ++i) {
    const series& s = all.series[i];
    if (s.study == key.study && s.build == key.build && s.common == common) return i;
  }
  all.series.push_back(
      {key.study, key.build, known.first(key.build).environment, build_name(known.first(key.build)), common});
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
        if (s.peak_rss_bytes)
          measured.peak_rss_bytes = std::max(measured.peak_rss_bytes.value_or(0), *s.peak_rss_bytes);
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

/// Keeps the best of what was measured for the same environment, threads and precision.
void add_peak(measurements& all, const peak_row& p) {
  for (peak_row& known : all.peaks)
    if (known.environment == p.environment && known.threads == p.threads && known.precision == p.precision) {
      known.bandwidth_bytes_per_s = std::max(known.bandwidth_bytes_per_s, p.bandwidth_bytes_per_s);
      known.flops_per_s = std::max(known.flops_per_s, p.flops_per_s);
      return;
    }
  all.peaks.push_back(p);
}

/// Above this share of the machine's time used by others, a round counts as disturbed.
constexpr double disturbing_share = 0.05;

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
    std::map<int, std::size_t> build_of_round;
    for (const sample& s : files[file].valid_samples()) {
      const environment_row& e = *environments.at(s.environment);
      if (listed.insert(e.environment + e.host + e.git).second) all.environments.push_back(e);
      const std::size_t build = known.add(e);
      known.measured_together(build_of_round.try_emplace(s.round, build).first->second, build);
      group& g = groups[{s.study, build, s.point}];
      g.cores = e.cores;
      g.rounds[{file, s.round}][s.repetition].push_back(s);
    }
  }
  for (const rows_file& file : files)
    for (const peak_row& p : file.peaks) add_peak(all, p);
  const std::string differences = known.differences();
  all.compares_builds = known.size() > 1 && known.are_a_factor();
  if (!differences.empty() && !all.compares_builds && !allow_mixed)
    throw error("the rows come from different machines or builds: " + differences +
                "; report them apart, or with --allow-mixed as series of their own");
  add_environment_caveats(all, differences);
  for (auto& entry : groups) add_group(all, entry.first, entry.second, known);
  return all;
}

std::vector<double> values_of(const measured_point& point, std::optional<double> phases::*phase) {
  std::vector<double> values;
  for (const auto& entry : point.rounds)
    if (entry.second.mean.*phase) values.push_back(*(entry.second.mean.*phase));
  return values;
}

std::optional<double> median_of(const measured_point& point, std::optional<double> phases::*phase) {
  const std::vector<double> values = values_of(point, phase);
  if (values.empty() || values.size() < point.rounds.size()) return std::nullopt;
  return median(values);
}

std::string label(const point& p) {
  return p.backend + " M=" + std::to_string(p.M) + " threads=" + std::to_string(p.threads);
}

std::string label(const measurements& all, const measured_point& p) {
  if (all.series.size() < 2) return label(p.point);
  const struct point& q = p.point;
  return fmt::format("{} ({}, {}, dx {}, {}, {}, {}, {}, {}, study {})", label(q), q.case_name, q.state, q.dx, q.order,
                     q.precision, q.interaction, q.smoothing, q.integrator, all.series[p.series].study);
}

std::string first_few(const std::vector<std::string>& texts) {
  constexpr std::size_t most = 3;
  std::string list;
  for (std::size_t k = 0; k < std::min(texts.size(), most); ++k) list += (k ? ", " : "") + texts[k];
  return texts.size() > most ? fmt::format("{} and {} more points", list, texts.size() - most) : list;
}

}  // namespace pairsum::harness

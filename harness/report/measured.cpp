#include "harness/report/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "harness/stats/median.hpp"

namespace pairsum::harness {
namespace {

auto order_of(const point& p) {
  return std::tie(p.case_name, p.state, p.dx, p.H, p.n_fluid, p.n_boundary, p.order, p.dim, p.precision, p.interaction,
                  p.smoothing, p.integrator, p.dt, p.isa, p.backend, p.grid, p.M, p.threads);
}

struct point_less {
  bool operator()(const point& a, const point& b) const { return order_of(a) < order_of(b); }
};

/// What makes two environments the same machine and build.
auto identity(const environment_row& e) { return std::tie(e.host, e.cpu, e.compiler, e.flags, e.git, e.dirty); }

/// The machines and builds that the environment rows name.
class builds {
 public:
  std::size_t add(const environment_row& e) {
    for (std::size_t i = 0; i < known_.size(); ++i)
      if (identity(known_[i]) == identity(e)) return i;
    known_.push_back(e);
    return known_.size() - 1;
  }

  const environment_row& first(std::size_t build) const { return known_[build]; }

  /// What differs between them, like `host (a, b), git (x, y)`; empty if nothing does.
  std::string differences() const {
    std::string text;
    add_difference(text, "host", [](const environment_row& e) { return e.host; });
    add_difference(text, "cpu", [](const environment_row& e) { return e.cpu; });
    add_difference(text, "compiler", [](const environment_row& e) { return e.compiler; });
    add_difference(text, "flags", [](const environment_row& e) { return e.flags; });
    add_difference(text, "git",
                   [](const environment_row& e) { return e.git + (e.dirty ? " with uncommitted changes" : ""); });
    return text;
  }

 private:
  template <class Get>
  void add_difference(std::string& text, const char* name, Get get) const {
    std::set<std::string> values;
    for (const environment_row& e : known_) values.insert(get(e));
    if (values.size() < 2) return;
    std::string list;
    for (const std::string& value : values) list += (list.empty() ? "" : ", ") + value;
    text += (text.empty() ? "" : ", ") + std::string(name) + " (" + list + ")";
  }

  std::vector<environment_row> known_;
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
  std::map<repetition_key, std::vector<sample>> repetitions;
  int cores = 1;
};

bool verified(const sample& s) { return !s.error && s.phases && s.verify.fingerprint; }

phases mean_over_steps(const std::vector<sample>& steps) {
  phases mean;
  for (const phase_member& phase : phase_members) {
    double sum = 0;
    std::size_t timed = 0;
    for (const sample& s : steps) {
      const std::optional<double>& value = (*s.phases).*phase.value;
      if (value) sum += *value;
      timed += value.has_value();
    }
    if (timed == steps.size()) mean.*phase.value = sum / static_cast<double>(timed);
  }
  return mean;
}

std::size_t series_of(measurements& all, const group_key& key, const builds& known) {
  point common = key.point;
  common.backend.clear();
  common.grid.clear();
  common.M = 0;
  common.threads = 0;
  for (std::size_t i = 0; i < all.series.size(); ++i) {
    const series& s = all.series[i];
    if (s.study == key.study && s.build == key.build && s.common == common) return i;
  }
  all.series.push_back({key.study, key.build, known.first(key.build).environment, common});
  return all.series.size() - 1;
}

void add_group(measurements& all, const group_key& key, group& g, const builds& known) {
  failed_point failed{key.point, key.study, 0, ""};
  measured_point measured;
  std::set<std::size_t> step_counts;
  for (auto& entry : g.repetitions) {
    std::vector<sample>& steps = entry.second;
    std::sort(steps.begin(), steps.end(), [](const sample& a, const sample& b) { return a.step < b.step; });
    const std::size_t passed = static_cast<std::size_t>(std::count_if(steps.begin(), steps.end(), verified));
    if (passed < steps.size()) {
      failed.rows += steps.size() - passed;
      for (const sample& s : steps)
        if (failed.error.empty() && !verified(s)) failed.error = s.error.value_or("not verified");
      continue;
    }
    measured.repetitions[entry.first] = mean_over_steps(steps);
    if (measured.fingerprint.empty()) measured.fingerprint = *steps.front().verify.fingerprint;
    step_counts.insert(steps.size());
    for (const sample& s : steps) {
      if (!measured.work) measured.work = s.work;
      if (s.peak_rss_bytes) measured.peak_rss_bytes = std::max(measured.peak_rss_bytes.value_or(0), *s.peak_rss_bytes);
    }
  }
  if (failed.rows > 0) all.failed.push_back(failed);
  if (measured.repetitions.empty()) return;
  measured.point = key.point;
  measured.series = series_of(all, key, known);
  measured.cores = g.cores;
  measured.steps = *step_counts.rbegin();
  if (step_counts.size() > 1)
    all.caveats.push_back(label(key.point) + ": its repetitions have " + std::to_string(*step_counts.begin()) + " to " +
                          std::to_string(*step_counts.rbegin()) + " steps");
  all.points.push_back(std::move(measured));
}

void add_environment_caveats(measurements& all, const std::string& differences) {
  if (!differences.empty()) all.caveats.push_back("rows of different machines or builds in one report: " + differences);
  std::set<std::string> bindings, governors;
  bool dirty = false;
  for (const environment_row& e : all.environments) {
    bindings.insert(e.binding);
    governors.insert(e.governor.value_or("unknown"));
    dirty = dirty || e.dirty;
  }
  if (dirty) all.caveats.push_back("built from a tree with uncommitted changes");
  if (bindings.size() > 1) all.caveats.push_back("rows with different bindings of the threads");
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
    for (const sample& s : files[file].valid_samples()) {
      const environment_row& e = *environments.at(s.environment);
      if (listed.insert(e.environment + e.host + e.git).second) all.environments.push_back(e);
      group& g = groups[{s.study, known.add(e), s.point}];
      g.cores = e.cores;
      g.repetitions[{file, s.round, s.repetition, s.slot}].push_back(s);
    }
  }
  const std::string differences = known.differences();
  if (!differences.empty() && !allow_mixed)
    throw error("the rows come from different machines or builds: " + differences +
                "; report them apart, or allow mixed rows");
  add_environment_caveats(all, differences);
  for (auto& entry : groups) add_group(all, entry.first, entry.second, known);
  return all;
}

std::vector<double> values_of(const measured_point& point, std::optional<double> phases::*phase) {
  std::vector<double> values;
  for (const auto& entry : point.repetitions)
    if (entry.second.*phase) values.push_back(*(entry.second.*phase));
  return values;
}

std::optional<double> median_of(const measured_point& point, std::optional<double> phases::*phase) {
  const std::vector<double> values = values_of(point, phase);
  if (values.empty() || values.size() < point.repetitions.size()) return std::nullopt;
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

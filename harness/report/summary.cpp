#include "harness/report/summary.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/report/comparisons.hpp"
#include "harness/stats/interval.hpp"
#include "harness/stats/median.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

json phase_entry(const measured_point& p, std::optional<double> phases::*phase) {
  json entry{{"median", nullptr}, {"low", nullptr}, {"high", nullptr}, {"confidence", nullptr}};
  const auto time = median_of(p, phase);
  if (!time) return entry;
  entry["median"] = *time;
  if (const auto bounds = median_interval(values_of(p, phase))) {
    entry["low"] = bounds->low;
    entry["high"] = bounds->high;
    entry["confidence"] = bounds->confidence;
  }
  return entry;
}

/// The phases that a backend needs to get the rates, with their keys in "ns_per_pair_parts".
constexpr phase_member pair_parts[] = {
    {"prepare", &phases::prepare_s}, {"zero", &phases::zero_s}, {"sum", &phases::sum_s}, {"reduce", &phases::reduce_s}};

/// The median over the repetitions of the time of all parts together; empty if one of them was not
/// timed in all repetitions.
std::optional<double> median_of_all_parts(const measured_point& p) {
  std::vector<double> times;
  for (const auto& entry : p.repetitions) {
    double time = 0;
    for (const phase_member& part : pair_parts) {
      const std::optional<double>& value = entry.second.*part.value;
      if (!value) return std::nullopt;
      time += *value;
    }
    times.push_back(time);
  }
  return median(times);
}

json ns_per_pair(const measured_point& p, std::optional<double> time) {
  if (!time || !p.work || p.work->pairs_interacting == 0) return nullptr;
  return *time * 1e9 / static_cast<double>(p.work->pairs_interacting);
}

json point_entry(const measurements& all, const measured_point& p) {
  json entry;
  entry["point"] = p.point;
  entry["study"] = all.series[p.series].study;
  entry["series"] = p.series;
  entry["repetitions"] = p.repetitions.size();
  entry["steps"] = p.steps;
  for (const phase_member& phase : phase_members) entry["phases"][phase.name] = phase_entry(p, phase.value);
  entry["ns_per_pair"] = ns_per_pair(p, median_of(p, &phases::sum_s));
  for (const phase_member& part : pair_parts)
    entry["ns_per_pair_parts"][part.name] = ns_per_pair(p, median_of(p, part.value));
  entry["ns_per_pair_parts"]["all"] = ns_per_pair(p, median_of_all_parts(p));
  entry["useful_pair_ratio"] = useful_pair_ratio(p);
  entry["work"] = p.work ? json(*p.work) : json(nullptr);
  entry["peak_rss_bytes"] = p.peak_rss_bytes ? json(*p.peak_rss_bytes) : json(nullptr);
  entry["fingerprint"] = p.fingerprint;
  return entry;
}

json series_entry(const series& s) {
  json entry = s.common;
  for (const char* varied : {"backend", "grid", "M", "threads"}) entry.erase(varied);
  entry["study"] = s.study;
  entry["environment"] = s.environment;
  return entry;
}

/// One caveat for all points of which the same is to be said.
template <class Says>
void add_point_caveat(const measurements& all, const std::string& what, Says says, std::vector<std::string>& caveats) {
  std::vector<std::string> points;
  for (const measured_point& p : all.points)
    if (says(p)) points.push_back(label(all, p));
  if (!points.empty()) caveats.push_back(what + ": " + first_few(points));
}

std::vector<std::string> without_repeats(const std::vector<std::string>& texts) {
  std::vector<std::string> unique;
  for (const std::string& text : texts)
    if (std::find(unique.begin(), unique.end(), text) == unique.end()) unique.push_back(text);
  return unique;
}

void write_whole(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw error(std::strerror(errno));
    done += static_cast<std::size_t>(count);
  }
  if (::fsync(file) != 0) throw error(std::strerror(errno));
}

}  // namespace

json build_summary(const measurements& all) {
  std::vector<std::string> caveats = all.caveats;
  add_point_caveat(
      all, "more threads than cores", [](const auto& p) { return p.point.threads > p.cores; }, caveats);
  add_point_caveat(
      all, "fewer than 6 repetitions, so no interval", [](const auto& p) { return p.repetitions.size() < 6; }, caveats);
  json summary;
  summary["schema"] = summary_schema;
  summary["sources"] = all.sources;
  summary["environments"] = all.environments;
  summary["series"] = json::array();
  for (const series& s : all.series) summary["series"].push_back(series_entry(s));
  summary["points"] = json::array();
  for (const measured_point& p : all.points) summary["points"].push_back(point_entry(all, p));
  summary["speedup"] = thread_speedups(all, caveats);
  summary["algorithm_speedup"] = algorithm_speedups(all, caveats);
  summary["runtime_comparison"] = runtime_comparisons(all, caveats);
  summary["m_comparison"] = m_comparisons(all);
  summary["failed"] = json::array();
  for (const failed_point& f : all.failed) {
    summary["failed"].push_back({{"point", f.point}, {"study", f.study}, {"rows", f.rows}, {"error", f.error}});
    caveats.push_back(label(f.point) + ": " + std::to_string(f.rows) + (f.rows == 1 ? " row" : " rows") +
                      " without a passed verification left out");
  }
  summary["caveats"] = without_repeats(caveats);
  return summary;
}

json build_summary(const std::vector<rows_file>& files, bool allow_mixed) {
  return build_summary(collect(files, allow_mixed));
}

void write_summary(const json& summary, const std::filesystem::path& path) {
  const std::string text = summary.dump(1) + "\n";
  const std::filesystem::path temporary = path.string() + "." + std::to_string(::getpid()) + ".tmp";
  int file = -1;
  try {
    std::error_code code;
    if (!path.parent_path().empty()) std::filesystem::create_directories(path.parent_path(), code);
    if (code) throw error("folder " + path.parent_path().string() + ": " + code.message());
    file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0) throw error(std::strerror(errno));
    write_whole(file, text);
    if (::rename(temporary.c_str(), path.c_str()) != 0) throw error(std::strerror(errno));
    ::close(file);
  } catch (const error& e) {
    if (file >= 0) {
      ::close(file);
      ::unlink(temporary.c_str());
    }
    throw error("cannot write the summary to " + path.string() + ": " + e.what());
  }
}

}  // namespace pairsum::harness

#include "harness/run/rows_so_far.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "harness/stats/interval.hpp"

namespace pairsum::harness {

rows_so_far::rows_so_far(const std::filesystem::path& path, const study_plan& plan) : study_(plan.study) {
  std::error_code code;
  if (!std::filesystem::exists(path, code) || std::filesystem::file_size(path, code) == 0) return;
  rows_ = read_rows(path, cut_line::drop);
  for (const sample& s : rows_.samples) last_round_ = std::max(last_round_, s.round);
  for (const pace_row& p : rows_.paces) last_round_ = std::max(last_round_, p.round);
  for (const void_row& v : rows_.voids) last_round_ = std::max(last_round_, v.round);
  for (const round_row& r : rows_.rounds) last_round_ = std::max(last_round_, r.round);
  const std::string hash = plan_hash(plan);
  std::set<int> before;  // rounds that stand before the last end
  for (std::size_t k = 0; k < rows_.ends.size(); ++k) {
    if (rows_.ends[k].study != study_ || rows_.ends[k].plan != hash) continue;
    for (std::size_t r = 0; r < rows_.rounds_before_end[k]; ++r)
      if (rows_.rounds[r].study == study_) before.insert(rows_.rounds[r].round);
  }
  for (const round_row& r : rows_.finished_rounds()) {
    if (r.study != study_ || r.plan != hash) continue;
    replicates_[r.part] = std::max(replicates_[r.part], r.replicate);
    if (!before.contains(r.round)) rounds_[r.part].push_back(r);
  }
}

const std::vector<round_row>& rows_so_far::rounds(const std::string& part) const {
  static const std::vector<round_row> none;
  const auto at = rounds_.find(part);
  return at == rounds_.end() ? none : at->second;
}

std::size_t rows_so_far::finished() const {
  std::size_t n = 0;
  for (const auto& [part, rounds] : rounds_) n += rounds.size();
  return n;
}

int rows_so_far::next_replicate(const std::string& part) const {
  const auto at = replicates_.find(part);
  return at == replicates_.end() ? 1 : at->second + 1;
}

std::vector<sample> rows_so_far::samples() const {
  std::set<int> wanted;
  for (const auto& [part, rounds] : rounds_)
    for (const round_row& r : rounds) wanted.insert(r.round);
  std::vector<sample> found;
  for (const sample& s : rows_.samples)
    if (s.study == study_ && wanted.count(s.round) != 0) found.push_back(s);
  return found;
}

std::optional<double> rows_so_far::half_width(const std::string& part) const {
  struct mean {
    double sum = 0;
    int n = 0;
  };
  std::vector<std::pair<point, std::map<std::pair<std::string, int>, mean>>> points;
  for (const sample& s : samples()) {
    if (s.part != part || !s.phases || !s.phases->sum_s) continue;
    auto at = std::ranges::find_if(points, [&](const auto& p) { return p.first == s.point; });
    if (at == points.end()) at = points.insert(points.end(), {s.point, {}});
    mean& m = at->second[{s.environment, s.round}];
    m.sum += *s.phases->sum_s;
    ++m.n;
  }
  double widest = 0;
  for (const auto& [p, rounds] : points) {
    std::map<std::string, std::vector<double>> by_build;
    for (const auto& [key, m] : rounds) by_build[key.first].push_back(m.sum / m.n);
    for (const auto& [build, times] : by_build) {
      const auto bounds = median_interval(times);
      if (!bounds) return std::nullopt;
      widest = std::max(widest, (bounds->high - bounds->low) / 2 / median(times));
    }
  }
  return points.empty() ? std::nullopt : std::optional(widest);
}

}  // namespace pairsum::harness

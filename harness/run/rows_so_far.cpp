#include "harness/run/rows_so_far.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/stats/interval.hpp"

namespace pairsum::harness {

rows_so_far::rows_so_far(const std::filesystem::path& path, const study_plan& plan)
    : reader_(path), study_(plan.study), plan_(plan_hash(plan)) {
  take_in(cut_line::drop);
}

std::size_t rows_so_far::drop_cut_line() {
  const std::size_t cut = reader_.drop_cut_line();
  take_in(cut_line::refuse);
  return cut;
}

void rows_so_far::take_in(cut_line last_line) {
  if (!reader_.has_rows()) return;
  reader_.read_on(last_line);
  const rows_file& all = reader_.rows();
  const auto count_rounds = [this](const auto& rows, std::size_t& seen, auto&& each) {
    for (; seen < rows.size(); ++seen) {
      last_round_ = std::max(last_round_, rows[seen].round);
      each(rows[seen]);
    }
  };
  count_rounds(all.samples, seen_.samples, [this](const sample& s) { take_in(s); });
  count_rounds(all.paces, seen_.paces, [](const pace_row&) {});
  count_rounds(all.voids, seen_.voids, [this](const void_row& v) {
    if (v.study == study_) voided_.insert(v.round);
  });
  count_rounds(all.rounds, seen_.rounds, [this](const round_row& r) {
    take_in_ends(seen_.rounds);
    take_in(r);
  });
  take_in_ends(all.rounds.size());
}

void rows_so_far::take_in(const sample& s) {
  if (s.study != study_) return;
  round_means& round = means_[s.round];
  ++round.samples;
  if (!s.phases || !s.phases->sum_s) return;
  auto at = std::ranges::find(points_, s.point);
  if (at == points_.end()) at = points_.insert(points_.end(), s.point);
  mean& m = round.times[{static_cast<std::size_t>(at - points_.begin()), s.environment}];
  m.sum += *s.phases->sum_s;
  ++m.n;
}

void rows_so_far::take_in(const round_row& r) {
  if (r.study != study_ || r.plan != plan_ || voided_.contains(r.round)) return;
  int& replicate = replicates_[r.part];
  replicate = std::max(replicate, r.replicate);
  rounds_[r.part].push_back(r);
  all_rounds_.push_back(r);
}

void rows_so_far::take_in_ends(std::size_t rounds_before) {
  const rows_file& all = reader_.rows();
  for (; seen_.ends < all.ends.size() && all.rounds_before_end[seen_.ends] <= rounds_before; ++seen_.ends)
    if (all.ends[seen_.ends].study == study_ && all.ends[seen_.ends].plan == plan_) rounds_.clear();
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
  for (const round_row& r : all_rounds_) wanted.insert(r.round);
  std::vector<sample> found;
  for (const sample& s : rows().samples)
    if (s.study == study_ && wanted.count(s.round) != 0) found.push_back(s);
  return found;
}

std::uint64_t rows_so_far::samples_of(int round) const {
  const auto at = means_.find(round);
  return at == means_.end() ? 0 : at->second.samples;
}

std::optional<double> rows_so_far::half_width(const std::string& part) const {
  std::map<std::pair<std::size_t, std::string>, std::vector<double>> times;  // by point and build, one per round
  for (const round_row& r : rounds(part))
    if (const auto at = means_.find(r.round); at != means_.end())
      for (const auto& [what, m] : at->second.times) times[what].push_back(m.sum / m.n);
  double widest = 0;
  for (const auto& [what, of_rounds] : times) {
    const auto bounds = median_interval(of_rounds);
    if (!bounds) return std::nullopt;
    widest = std::max(widest, (bounds->high - bounds->low) / 2 / median(of_rounds));
  }
  return times.empty() ? std::nullopt : std::optional(widest);
}

bool rows_so_far::done(const part_plan& part) const {
  const int made = static_cast<int>(rounds(part.request.part).size());
  if (made >= part.most_rounds) return true;
  if (made < part.least_rounds || part.half_width == 0) return false;
  const auto width = half_width(part.request.part);
  return width && *width <= part.half_width;
}

std::string rows_so_far::standing(const part_plan& part) const {
  const std::string& name = part.request.part;
  std::string text = fmt::format("{} round {}/{}", name, rounds(name).size() + 1, part.most_rounds);
  if (const auto width = half_width(name))
    text += fmt::format(", +-{:.1f} %{}", 100 * *width,
                        part.half_width > 0 ? fmt::format(" (goal {:.1f})", 100 * part.half_width) : "");
  return text;
}

}  // namespace pairsum::harness

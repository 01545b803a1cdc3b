#include "harness/report/self_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/report/compared_points.hpp"
#include "harness/report/judged_entries.hpp"
#include "harness/report/table_cells.hpp"
#include "harness/self_test/entries.hpp"
#include "harness/stats/ratio.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// A copy's time over its base's, paired by round.
ratio_estimate own_over_base(const measured_point& own, const measured_point& base, double level) {
  std::vector<double> own_times, base_times;
  for (const auto& [round, value] : own.rounds) {
    const auto match = base.rounds.find(round);
    if (match == base.rounds.end() || !value.mean.sum_s || !match->second.mean.sum_s) continue;
    own_times.push_back(*value.mean.sum_s);
    base_times.push_back(*match->second.mean.sum_s);
  }
  if (own_times.empty()) return {};
  return paired_ratio(own_times, base_times, level);
}

json entry_of(const self_test_entry& e, const point& p) {
  return {{"what", e.what},   {"backend", e.word}, {"base_backend", e.base}, {"case", p.case_name},
          {"state", p.state}, {"dx", p.dx},        {"grid", p.grid},         {"isa", p.isa},
          {"block", p.block}, {"M", m_or_null(p)}, {"threads", p.threads},   {"expected", nullptr},
          {"ratio", nullptr}, {"low", nullptr},    {"high", nullptr},        {"confidence", nullptr},
          {"holds", false}};
}

void judge_ratio(json& entry, double expected, const ratio_estimate& r) {
  entry["expected"] = expected;
  if (r.pairs == 0) {
    entry["text"] = "its base was not measured in the same rounds";
    return;
  }
  entry["ratio"] = r.value;
  if (!r.bounds) {
    entry["text"] = "too few rounds for an interval";
    return;
  }
  put_bounds(entry, r.bounds);
  const bool inside = r.bounds->low <= expected && expected <= r.bounds->high;
  const bool told = expected == 1 || r.bounds->low > 1;
  entry["holds"] = inside;
  entry["text"] = fmt::format("{:.4f} [{:.4f}, {:.4f}], {:g} expected: {}{}", r.value, r.bounds->low, r.bounds->high,
                              expected, inside ? "inside the interval" : "OUTSIDE the interval",
                              expected == 1 ? ""
                              : told        ? ", told from its base"
                                            : ", not told from its base");
}

}  // namespace

bool is_self_test(const std::string& backend) {
  return std::ranges::any_of(self_test_entries(), [&](const self_test_entry& e) { return e.word == backend; });
}

std::string working_backend(const std::string& backend) {
  for (const self_test_entry& e : self_test_entries())
    if (e.word == backend) return std::string(e.base);
  return backend;
}

json self_tests(const measurements& all, std::vector<std::string>& caveats) {
  json entries = json::array();
  std::size_t ratios = 0;
  for (const measured_point& p : all.points) ratios += is_self_test(p.point.backend);
  const double level = ratios > 0 ? 1 - 0.05 / static_cast<double>(ratios) : 0.95;
  for (const self_test_entry& e : self_test_entries()) {
    for (const measured_point& own : all.points) {
      if (own.point.backend != e.word) continue;
      json entry = entry_of(e, own.point);
      if (!e.expected_ratio()) {
        entry["text"] = "it got a time, although it is wrong";
      } else {
        for (const measured_point& base : all.points) {
          point like = own.point;
          like.backend = e.base;
          if (base.series != own.series || !(base.point == like)) continue;
          judge_ratio(entry, *e.expected_ratio(), own_over_base(own, base, level));
        }
      }
      entries.push_back(entry);
    }
    for (const failed_point& f : all.failed) {
      if (f.point.backend != e.word) continue;
      json entry = entry_of(e, f.point);
      entry["holds"] = !e.expected_ratio();
      entry["text"] = (e.expected_ratio() ? "failed its verification: " : "refused, as it must be: ") + f.error;
      entries.push_back(entry);
    }
  }
  for (json& entry : entries) {
    if (!entry.contains("text")) entry["text"] = "its base was not measured";
    if (!entry["holds"])
      caveats.push_back(fmt::format("self-test {}{} threads={} does not hold: {}", entry["backend"].get<std::string>(),
                                    m_text(entry["M"]), entry["threads"].get<int>(), entry["text"].get<std::string>()));
  }
  return entries;
}

}  // namespace pairsum::harness

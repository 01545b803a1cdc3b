#include "harness/report/compared_points.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include <pairsum/core/isa.hpp>
#include <pairsum/sum/registry.hpp>
#include "harness/report/self_tests.hpp"

namespace pairsum::harness {

using nlohmann::json;

ratio_estimate ratio_of(const measurements& all, const measured_point& base, const measured_point& other,
                        std::vector<std::string>& caveats, std::optional<double> phases::*phase) {
  std::vector<double> base_times, other_times;
  for (const auto& [round, value] : base.rounds) {
    const auto match = other.rounds.find(round);
    if (match == other.rounds.end() || !(value.mean.*phase) || !(match->second.mean.*phase)) continue;
    base_times.push_back(*(value.mean.*phase));
    other_times.push_back(*(match->second.mean.*phase));
  }
  if (!base_times.empty()) return paired_ratio(base_times, other_times);
  caveats.push_back(label(all, base) + " and " + label(all, other) +
                    " were measured in different rounds: their ratio is not paired");
  return unpaired_ratio(values_of(base, phase), values_of(other, phase));
}

bool have_like_isa(const point& p, const point& q) {
  if (p.isa == q.isa) return true;
  const auto is_made_for = [](const point& one) {
    const std::string backend = working_backend(one.backend);
    const bool vector = std::ranges::any_of(registry::instance().backends(), [&](const backend_entry& b) {
      return b.traits.name == backend && b.traits.vector;
    });
    return vector == (one.isa != scalar_isa);
  };
  return is_made_for(p) && is_made_for(q);
}

bool is_timed(const measured_point& p) { return comparable_time(p, &phases::sum_s).has_value(); }

bool has_best_granularity(const measurements& all, const measured_point& p, std::optional<double> phases::*phase) {
  const auto own = comparable_time(p, phase);
  if (!own) return false;
  for (const measured_point& q : all.points) {
    point like = q.point;
    like.granularity = p.point.granularity;
    if (&q == &p || q.series != p.series || !(like == p.point)) continue;
    const auto time = comparable_time(q, phase);
    if (time && (*time < *own || (*time == *own && &q < &p))) return false;
  }
  return true;
}

json m_or_null(const point& p) { return p.M > 0 ? json(p.M) : json(nullptr); }

json place_of(const measured_point& p) {
  return {{"series", p.series},
          {"case", p.point.case_name},
          {"state", p.point.state},
          {"dx", p.point.dx},
          {"backend", p.point.backend},
          {"grid", p.point.grid},
          {"granularity", p.point.granularity},
          {"isa", p.point.isa},
          {"block", p.point.block},
          {"M", m_or_null(p.point)},
          {"threads", p.point.threads}};
}

json time_or_null(const measured_point& p, std::optional<double> phases::*phase) {
  const auto time = median_of(p, phase);
  return time ? json(*time) : json(nullptr);
}

}  // namespace pairsum::harness

#include "harness/report/ladders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <pairsum/sum/registry.hpp>
#include "harness/report/self_tests.hpp"

namespace pairsum::harness {
namespace {

/// Each backend's fastest among points that may be taken, fastest first.
template <class May>
std::vector<rung> fastest_of_each(const measurements& all, std::size_t series, May may) {
  std::map<std::string, rung> best;
  for (const measured_point& p : all.points) {
    if (p.series != series || is_self_test(p.point.backend) || !may(p.point)) continue;
    rung r{&p, evaluations_of(p), 0};
    if (r.times.empty()) continue;
    r.time_s = median_of(r.times);
    const auto at = best.find(p.point.backend);
    if (at == best.end() || r.time_s < at->second.time_s) best[p.point.backend] = std::move(r);
  }
  std::vector<rung> rungs;
  for (auto& [backend, r] : best) rungs.push_back(std::move(r));
  std::ranges::stable_sort(rungs, {}, &rung::time_s);
  return rungs;
}

void add_ladder(std::vector<ladder>& ladders, std::size_t series, const char* at, std::vector<rung> rungs) {
  constexpr std::size_t fewest = 3;
  if (rungs.size() < fewest) return;
  ladder l{series, at, std::move(rungs), 0};
  for (const char* base : ladder_bases)
    if (const auto place = l.place_of(base)) {
      l.base = *place;
      ladders.push_back(std::move(l));
      return;
    }
}

/// Do the series that are not self-tests differ in this?
template <class Value>
bool differs(const measurements& all, Value value) {
  std::set<std::string> seen;
  for (const series& s : all.series) seen.insert(value(s));
  return seen.size() > 1;
}

}  // namespace

std::optional<std::size_t> ladder::place_of(const std::string& backend) const {
  const auto at = std::ranges::find(rungs, backend, [](const rung& r) { return r.p->point.backend; });
  return at == rungs.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - rungs.begin()));
}

std::vector<ladder> ladders_of(const measurements& all) {
  std::vector<ladder> ladders;
  for (std::size_t series = 0; series < all.series.size(); ++series) {
    std::map<std::string, int> most;
    for (const measured_point& p : all.points)
      if (p.series == series) most[p.point.backend] = std::max(most[p.point.backend], p.point.threads);
    add_ladder(ladders, series, "one_thread",
               fastest_of_each(all, series, [](const point& p) { return p.threads == 1; }));
    if (std::ranges::any_of(most, [](const auto& m) { return m.second > 1; }))
      add_ladder(ladders, series, "most_threads",
                 fastest_of_each(all, series, [&](const point& p) { return p.threads == most[p.backend]; }));
  }
  return ladders;
}

const backend_traits* traits_of(const std::string& backend) {
  const auto& known = registry::instance().backends();
  const auto at = std::ranges::find(known, backend, [](const backend_entry& b) { return b.traits.name; });
  return at == known.end() ? nullptr : &at->traits;
}

std::string world_words(const measurements& all, std::size_t series) {
  const struct series& own = all.series[series];
  const point& p = own.common;
  std::string text = fmt::format("{} {}D", p.case_name, p.dim);
  const double reach = p.H / p.dx;
  if (std::abs(reach - 2) > 0.005) text += fmt::format(", H = {:.3g} dx", reach);
  const auto tell = [&](auto value) {
    if (differs(all, value)) text += ", " + value(own);
  };
  tell([](const auto& s) { return s.common.state; });
  tell([](const auto& s) { return s.common.order; });
  tell([](const auto& s) { return s.common.precision; });
  tell([](const auto& s) { return s.common.interaction; });
  tell([](const auto& s) { return s.study; });
  tell([](const auto& s) { return s.build_name; });
  for (std::size_t k = 0; k < all.series.size(); ++k) {  // sizes alone are left to tell them apart
    const point& q = all.series[k].common;
    if (k == series || q.case_name != p.case_name || q.dim != p.dim || std::abs(q.H / q.dx - reach) > 0.005) continue;
    if (q.dx != p.dx) return text + fmt::format(", dx = {:g}", p.dx);
  }
  return text;
}

}  // namespace pairsum::harness

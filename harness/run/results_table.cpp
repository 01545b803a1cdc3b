#include "harness/run/results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "harness/stats/median.hpp"

namespace pairsum::harness {
namespace {

struct collected {
  point what;
  std::map<int, std::vector<const sample*>> rounds;
  std::optional<work_row> work;
  std::string error;
};

std::vector<collected> by_point(const std::vector<sample>& samples) {
  std::vector<collected> all;
  for (const sample& s : samples) {
    auto at = std::ranges::find_if(all, [&](const collected& c) { return c.what == s.point; });
    if (at == all.end()) at = all.insert(all.end(), collected{s.point, {}, {}, {}});
    if (s.error) {
      at->error = *s.error;
    } else {
      at->rounds[s.round].push_back(&s);
      if (s.work) at->work = s.work;
    }
  }
  return all;
}

double median_ms(const collected& c, std::optional<double> phases::*phase) {
  std::vector<double> means;
  for (const auto& [round, steps] : c.rounds) {
    double sum = 0;
    for (const sample* s : steps) sum += ((*s->phases).*phase).value_or(0);
    means.push_back(1e3 * sum / static_cast<double>(steps.size()));
  }
  return median(means);
}

}  // namespace

std::string words_of(const point& p) {
  return fmt::format("{}, {}, {}, {}, order {}{}", p.precision, p.interaction, p.smoothing, p.integrator, p.order,
                     p.granularity == "none" ? "" : ", " + p.granularity);
}

std::string results_table(const std::vector<sample>& samples) {
  std::string text = fmt::format("{:<16}{:>10}{:>11}{:>4}{:>4}{:>5}{:>10}{:>10}{:>10}{:>10}{:>9}\n", "backend", "dx",
                                 "state", "M", "thr", "rnd", "index ms", "prep ms", "sum ms", "total ms", "ns/pair");
  std::vector<collected> all = by_point(samples);
  std::map<std::string, std::size_t> first;  // points with the same words stand together, in the order measured
  for (const collected& c : all) first.try_emplace(words_of(c.what), first.size());
  std::ranges::stable_sort(all, {}, [&](const collected& c) { return first.at(words_of(c.what)); });
  std::string heading;
  for (const collected& c : all) {
    if (first.size() > 1 && words_of(c.what) != heading) {
      heading = words_of(c.what);
      text += heading + "\n";
    }
    text += fmt::format("{:<16}{:>10}{:>11}{:>4}{:>4}{:>5}", c.what.backend, c.what.dx, c.what.state, c.what.M,
                        c.what.threads, c.rounds.size());
    if (!c.error.empty()) {
      text += "  FAILED: " + c.error + "\n";
      continue;
    }
    const double sum = median_ms(c, &phases::sum_s);
    const double pairs = c.work ? static_cast<double>(c.work->pairs_interacting) : 0;
    text += fmt::format("{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}{:>9}\n", median_ms(c, &phases::index_s),
                        median_ms(c, &phases::prepare_s), sum, median_ms(c, &phases::total_s),
                        pairs > 0 ? fmt::format("{:.1f}", 1e6 * sum / pairs) : "-");
  }
  return text;
}

}  // namespace pairsum::harness

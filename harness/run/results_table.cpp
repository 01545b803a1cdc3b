#include "harness/run/results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "harness/rows/point_words.hpp"
#include "harness/rows/variant_names.hpp"
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
  return fmt::format("{} {}D, H = {:.3g} dx, {}, {}, {}, {}, order {}", p.case_name, p.dim, p.H / p.dx, p.precision,
                     p.interaction, p.smoothing, p.integrator, p.order);
}

std::string results_table(const std::vector<sample>& samples) {
  std::vector<collected> all = by_point(samples);
  std::ranges::sort(all, {}, [](const collected& c) {
    const point& p = c.what;
    return std::tuple(words_of(p), p.dx, p.state, p.backend, p.grid, p.isa, p.block, p.granularity, p.M, p.threads);
  });
  variant_names name;
  for (const collected& c : all) name.add(c.what);
  std::size_t width = 16;
  for (const collected& c : all) width = std::max(width, name(c.what).size() + 1);
  std::string text =
      fmt::format("{:<{}}{:>10}{:>11}{:>4}{:>4}{:>7}{:>10}{:>10}{:>10}{:>10}{:>9}\n", "backend", width, "dx", "state",
                  "M", "thr", "rounds", "index ms", "prep ms", "sum ms", "total ms", "ns/pair");
  const bool headings = !all.empty() && words_of(all.front().what) != words_of(all.back().what);
  std::string heading;
  for (const collected& c : all) {
    if (headings && words_of(c.what) != heading) {
      heading = words_of(c.what);
      text += heading + "\n";
    }
    text += fmt::format("{:<{}}{:>10}{:>11}{:>4}{:>4}{:>7}", name(c.what), width, c.what.dx, c.what.state,
                        m_word(c.what.M), c.what.threads, c.rounds.size());
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

#include "harness/run/results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "harness/measure/cpu_time.hpp"
#include "harness/run/level_columns.hpp"
#include "harness/terminal/terminal.hpp"

namespace pairsum::harness {
namespace {

constexpr std::size_t most_named = 3;  ///< in a verdict
constexpr std::size_t least_rows = 3;  ///< of a problem, if it is shown

/// "1234", "123.4", "12.34", "1.234", "0.1234": four digits.
std::string digits(double value) {
  return fmt::format("{:.{}f}", value, value >= 1000 ? 0 : value >= 100 ? 1 : value >= 10 ? 2 : value >= 1 ? 3 : 4);
}

std::string interval_text(const std::optional<interval>& i, double unit) {
  return i ? fmt::format("[{}, {}]", digits(unit * i->low), digits(unit * i->high)) : "-";
}

std::vector<double> values_of(const std::map<int, double>& by_round) {
  std::vector<double> values;
  for (const auto& [round, value] : by_round) values.push_back(value);
  return values;
}

struct cell {
  std::string text;
  std::optional<tone> how = {};
};
using line = std::vector<cell>;

/// The row of a point that is `place`-th from the fastest; of one alone, or without a rank, there is no ratio.
line row_of(const ranked& r, std::size_t place, const level_columns& levels, bool alone) {
  line cells{{r.what.backend}};
  const bool fastest = place == 0 && r.has_rank();
  if (fastest && !alone) cells.front().how = tone::good;
  for (const std::string& word : levels.words_of(r)) cells.push_back({word});
  const std::vector<double> step = values_of(r.step_s), sum = values_of(r.sum_s);
  const double sum_s = median(sum);
  cells.push_back({digits(1e3 * median(step))});
  cells.push_back({interval_text(median_interval(step), 1e3)});
  if (!alone && !r.has_rank()) {
    cells.insert(cells.end(), {{"-"}, {"-"}, {"no answer", tone::doubtful}});
  } else if (!alone && fastest) {
    cells.insert(cells.end(), {{digits(1)}, {""}, {"fastest", tone::good}});
  } else if (!alone) {
    cells.push_back({digits(r.ratio.value)});
    cells.push_back({interval_text(r.ratio.bounds, 1)});
    cells.push_back(r.is_slower                  ? cell{"slower"}
                    : r.ratio.pairs == 0         ? cell{"other rounds", tone::doubtful}
                    : r.ratio.bounds.has_value() ? cell{"not resolved", tone::doubtful}
                                                 : cell{"too few rounds", tone::doubtful});
  }
  cells.push_back({digits(1e3 * sum_s)});
  cells.push_back({r.pairs > 0 ? fmt::format("{:.1f}", 1e9 * sum_s / r.pairs) : "-"});
  return cells;
}

/// Lines in columns, the first of them on the left.
std::string aligned(const std::vector<line>& lines, bool colours) {
  std::vector<std::size_t> widths;
  for (const line& l : lines) {
    widths.resize(std::max(widths.size(), l.size()));
    if (l.size() < 2) continue;  // a line without columns
    for (std::size_t k = 0; k < l.size(); ++k) widths[k] = std::max(widths[k], columns_in(l[k].text));
  }
  std::string text;
  for (const line& l : lines) {
    std::string row;
    for (std::size_t k = 0; k < l.size(); ++k) {
      const std::string pad(l.size() < 2 ? 0 : widths[k] - columns_in(l[k].text), ' ');
      const std::string shown = l[k].how ? coloured(*l[k].how, l[k].text, colours) : l[k].text;
      row += (k == 0 ? "" : "  ") + (k == 0 ? shown + pad : pad + shown);
    }
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

/// "X ran 1.23 [1.20, 1.26] times as fast as Y", and what could not be told from X; empty for a point alone.
std::string verdict_line(const ranking& points, const level_columns& levels, bool colours) {
  std::vector<std::string> slower, same;
  bool any_interval = false;
  for (std::size_t k = 1; k < points.size() && points[k].has_rank(); ++k) {
    const ranked& r = points[k];
    any_interval = any_interval || r.ratio.bounds;
    if (r.is_slower)
      slower.push_back(fmt::format("{} {} times as fast as {}", digits(r.ratio.value), interval_text(r.ratio.bounds, 1),
                                   levels.name_of(r)));
    else
      same.push_back(levels.name_of(r));
  }
  if (slower.empty() && same.empty()) return "";
  const std::string name = levels.name_of(points.front());
  const auto some = [](const std::vector<std::string>& all, const std::string& separator) {
    std::string text;
    for (std::size_t k = 0; k < std::min(all.size(), most_named); ++k) text += (k == 0 ? "" : separator) + all[k];
    return text;
  };
  const std::string rest = same.size() > most_named ? fmt::format(" and {} more", same.size() - most_named) : "";
  if (slower.empty())
    return coloured(tone::doubtful, "nothing is decided", colours) +
           (!any_interval ? fmt::format(": a ratio's interval needs {} rounds that have both", fewest_for_ratio)
                          : fmt::format(": {} had the shortest times, and cannot be told from {}{}", name,
                                        some(same, ", "), rest));
  std::string text = fmt::format("{} ran {}", coloured(tone::good, name, colours),
                                 some(slower, ",\n" + std::string(columns_in(name) + 5, ' ')));
  if (!same.empty())
    text += "\n" + coloured(tone::doubtful, "not decided", colours) +
            fmt::format(" between it and {}{}", some(same, ", "), rest);
  return text;
}

}  // namespace

std::string results_table(const std::vector<ranking>& all, bool colours, std::size_t most_rows) {
  const level_columns levels(all);
  line head{{"backend"}};
  for (const std::string& name : levels.names()) head.push_back({name});
  const bool alone = std::ranges::all_of(all, [](const ranking& r) { return r.size() < 2; });
  for (const char* const name : {"step ms", "[low, high]"}) head.push_back({name});
  if (!alone)
    for (const char* const name : {"ratio", "[low, high]", "it is"}) head.push_back({name});
  for (const char* const name : {"sum ms", "ns/pair"}) head.push_back({name});
  for (cell& c : head) c.how = tone::strong;
  std::vector<line> lines{
      {{levels.common() + (levels.common().empty() ? "" : "; ") + "medians of rounds, intervals of 95 %"}}, head};
  const std::size_t rows_each = std::max(least_rows, most_rows / std::max<std::size_t>(1, all.size()));
  std::size_t shown = 0, hidden = 0;
  for (const ranking& points : all) {
    std::vector<line> own;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const ranked& r = points[k];
      if (!r.error.empty()) {
        own.push_back({{levels.name_of(r) + " FAILED: " + r.error, tone::doubtful}});
      } else if (k >= rows_each || shown >= most_rows) {
        ++hidden;
      } else if (!r.step_s.empty()) {
        own.push_back(row_of(r, k, levels, alone));
        ++shown;
        if (r.lost > 0)
          own.push_back(
              {{fmt::format(
                    "{} lost {} of {} fluid particles: its later steps sum the others alone, so it is not ranked",
                    levels.name_of(r), r.lost, r.what.n_fluid),
                tone::doubtful}});
      }
    }
    if (own.empty()) continue;
    const point& p = points.front().what;
    lines.push_back(
        {{fmt::format("\n{}: {} fluid and {} boundary particles", problem_words(p), p.n_fluid, p.n_boundary)}});
    std::ranges::move(own, std::back_inserter(lines));
    if (const std::string said = verdict_line(points, levels, colours); !said.empty()) lines.push_back({{said}});
  }
  if (hidden > 0) lines.push_back({{fmt::format("\n{} more in the report", hidden)}});
  return aligned(lines, colours);
}

std::string disturbance_text(const std::vector<round_row>& rounds, std::size_t voids) {
  const auto disturbed =
      std::ranges::count_if(rounds, [](const round_row& r) { return r.others_share.value_or(0) > disturbing_share; });
  std::string text;
  if (disturbed > 0)
    text = fmt::format(
        "in {} of {} rounds other processes used more than {:.0f} % of the machine: close them and run again with "
        "--fresh",
        disturbed, rounds.size(), 100 * disturbing_share);
  if (voids > 0)
    text += fmt::format("{}{} void, cut before {} end", text.empty() ? "" : "; ",
                        voids == 1 ? "1 round is" : fmt::format("{} rounds are", voids), voids == 1 ? "its" : "their");
  return text;
}

bool has_intervals(const std::vector<ranking>& all) {
  return std::ranges::all_of(all, [](const ranking& points) {
    return std::ranges::all_of(
        points, [](const ranked& r) { return !r.error.empty() || ranks_of_median(r.step_s.size()).has_value(); });
  });
}

}  // namespace pairsum::harness

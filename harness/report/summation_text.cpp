#include <algorithm>
#include <utility>

#include "harness/report/report_tables.hpp"
#include "harness/report/table_cells.hpp"
#include "harness/rows/point_words.hpp"

namespace pairsum::harness {
namespace {

/// One line of numbers of a point at one number of threads, in columns of a fixed width.
std::pair<std::string, std::string> time_cell(const json& point, const json* speedup) {
  const json& sum = point.at("phases").at("sum_s");
  const std::string interval = sum["low"].is_null()
                                   ? "no interval"
                                   : fmt::format("[{:>8}, {:>8}]", ms(number(sum["low"])), ms(number(sum["high"])));
  const std::string own = speedup ? fixed(speedup->at("speedup"), 2) + "x" : "-";
  const std::string efficiency = speedup ? fmt::format("{:.0f}%", 100 * number(speedup->at("efficiency"))) : "-";
  const json& pair = point.at("ns_per_pair");
  return {fmt::format("{:>8} {:>20}", ms(number(sum["median"])), interval),
          fmt::format("{:>8} {:>6} {:>13}", own, efficiency, pair.is_null() ? "-" : fixed(pair, 3) + " ns")};
}

}  // namespace

std::string summation_text(const json& summary, std::size_t series) {
  using row_key = std::pair<std::string, int>;
  std::map<row_key, std::map<int, std::pair<std::string, std::string>>> rows;
  std::set<int> threads;
  std::size_t name_width = 7;
  const std::vector<json> speedups = entries(summary, "speedup", series);
  const point_names names(summary);
  for (const json& entry : entries(summary, "points", series)) {
    const json& p = entry.at("point");
    const json* own = nullptr;
    for (const json& s : speedups)
      if (same_point(s, p)) own = &s;
    const std::string name = names(p);
    name_width = std::max(name_width, name.size());
    threads.insert(p["threads"].get<int>());
    rows[{name, p["M"].is_null() ? 0 : p["M"].get<int>()}][p["threads"].get<int>()] = time_cell(entry, own);
  }
  const std::vector<int> columns(threads.begin(), threads.end());
  const std::size_t fit = std::max<std::size_t>(1, (120 - name_width - 5) / 31);
  std::string out =
      "Summation time per step: median ms [low, high]; below it the speedup and efficiency over "
      "the "
      "same backend on 1\nthread (the base), and ns per interacting pair\n";
  for (std::size_t first = 0; first < columns.size(); first += fit) {
    const std::size_t last = std::min(columns.size(), first + fit);
    std::vector<std::string> header{"backend", "M"};
    for (std::size_t c = first; c < last; ++c) header.push_back(fmt::format("threads {}", columns[c]));
    text_table table(header, 2);
    for (const auto& row : rows) {
      std::vector<std::string> above{row.first.first, m_word(row.first.second)};
      std::vector<std::string> below{"", ""};
      for (std::size_t c = first; c < last; ++c) {
        const auto cell = row.second.find(columns[c]);
        above.push_back(cell == row.second.end() ? "-" : cell->second.first);
        below.push_back(cell == row.second.end() ? "" : cell->second.second);
      }
      table.add(above);
      table.add(below);
    }
    out += table.text() + "\n";
  }
  return out;
}

}  // namespace pairsum::harness

#include "harness/report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "harness/report/text_table.hpp"
#include "harness/rows/row.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

double number(const json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string fixed(const json& value, int digits) {
  return value.is_number() ? fmt::format("{:.{}f}", value.get<double>(), digits) : "-";
}

std::string whole(const json& value) { return value.is_null() ? "-" : value.dump(); }

std::string bounds(const json& entry) {
  if (entry.at("low").is_null()) return "no interval";
  return fmt::format("[{:.3f}, {:.3f}]", number(entry["low"]), number(entry["high"]));
}

/// The entries of one array of the summary that belong to a series.
std::vector<json> entries(const json& summary, const char* name, std::size_t series) {
  std::vector<json> found;
  for (const json& entry : summary.at(name))
    if (entry.at("series") == series) found.push_back(entry);
  return found;
}

std::string backend_name(const json& point) {
  const std::string name = point.at("backend"), grid = point.at("grid");
  return grid == "hashed_grid" || grid.empty() ? name : name + "/" + grid;
}

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

std::string summation_table(const json& summary, std::size_t series) {
  using row_key = std::pair<std::string, int>;
  std::map<row_key, std::map<int, std::pair<std::string, std::string>>> rows;
  std::set<int> threads;
  std::size_t name_width = 7;
  const std::vector<json> speedups = entries(summary, "speedup", series);
  for (const json& entry : entries(summary, "points", series)) {
    const json& p = entry.at("point");
    const json* own = nullptr;
    for (const json& s : speedups)
      if (s["backend"] == p["backend"] && s["grid"] == p["grid"] && s["M"] == p["M"] && s["threads"] == p["threads"])
        own = &s;
    const std::string name = backend_name(p);
    name_width = std::max(name_width, name.size());
    threads.insert(p["threads"].get<int>());
    rows[{name, p["M"].get<int>()}][p["threads"].get<int>()] = time_cell(entry, own);
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
      std::vector<std::string> above{row.first.first, std::to_string(row.first.second)};
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

std::string algorithm_table(const json& summary, std::size_t series) {
  text_table table({"runtime", "threads", "backend", "time ms", "base", "base ms", "speedup", "[low, high]"}, 3);
  for (const json& e : entries(summary, "algorithm_speedup", series))
    table.add({e["runtime"], whole(e["threads"]), fmt::format("{} M={}", backend_name(e), e["M"].get<int>()),
               ms(number(e["time_s"])),
               fmt::format("{} M={}", e["base_backend"].get<std::string>(), e["base_M"].get<int>()),
               ms(number(e["base_time_s"])), fixed(e["speedup"], 3), bounds(e)});
  if (table.empty()) return "";
  return "Algorithm speedup: summation time of the base over that of the backend, at the same "
         "number "
         "of threads\n" +
         table.text() + "\n";
}

std::string runtime_table(const json& summary, std::size_t series) {
  text_table table({"algorithm", "M", "threads", "OpenMP ms", "TBB ms", "OpenMP/TBB", "[low, high]", "faster"}, 1);
  for (const json& e : entries(summary, "runtime_comparison", series)) {
    std::string verdict = e["low"].is_null() ? "-" : "not resolved";
    if (number(e["low"]) > 1) verdict = "TBB";
    if (number(e["high"]) < 1) verdict = "OpenMP";
    table.add({e["algorithm"], whole(e["M"]), whole(e["threads"]), ms(number(e["omp_time_s"])),
               ms(number(e["tbb_time_s"])), fixed(e["ratio"], 3), bounds(e), verdict});
  }
  if (table.empty()) return "";
  return "OpenMP against TBB: summation time, and OpenMP's over TBB's (the base); not resolved: "
         "the "
         "interval holds 1\n" +
         table.text() + "\n";
}

std::string m_table(const json& summary, std::size_t series) {
  text_table table(
      {"backend", "threads", "M", "sum ms", "total ms", "cells", "non-empty", "pairs tested", "interacting", "useful"},
      1);
  for (const json& e : entries(summary, "m_comparison", series))
    table.add({backend_name(e), whole(e["threads"]), whole(e["M"]), ms(number(e["time_s"])), ms(number(e["total_s"])),
               whole(e["cells"]), whole(e["cells_nonempty"]), whole(e["pairs_tested"]), whole(e["pairs_interacting"]),
               fixed(e["useful_pair_ratio"], 4)});
  return "Comparison over M: median times per step, cells, distance tests and pairs found (useful: "
         "found per test)\n" +
         table.text() + "\n";
}

std::string phase_table(const json& summary, std::size_t series) {
  std::vector<std::string> header{"backend", "M", "thr"};
  for (const phase_member& phase : phase_members) {
    const std::string name = phase.name;
    header.push_back(name.substr(0, name.size() - 2));
  }
  text_table table(header, 1);
  for (const json& entry : entries(summary, "points", series)) {
    const json& p = entry.at("point");
    std::vector<std::string> cells{backend_name(p), whole(p["M"]), whole(p["threads"])};
    const double total = number(entry["phases"]["total_s"]["median"]);
    for (const phase_member& phase : phase_members) {
      const double time = number(entry["phases"][phase.name]["median"]);
      const bool share = std::string(phase.name) != "total_s" && std::isfinite(time / total);
      cells.push_back(share ? fmt::format("{} {:>3.0f}%", ms(time), 100 * time / total) : ms(time));
    }
    table.add(cells);
  }
  return "Phases per step: median ms and share of the total (pair lists: prepare makes the list, "
         "sum "
         "sweeps it)\n" +
         table.text() + "\n";
}

std::string title(const json& summary, const json& s) {
  std::string text = fmt::format(
      "== {}, {}, dx {}: {} fluid and {} boundary particles; study {}, order {}, {}D, {}, {}, {}, "
      "{}, "
      "dt {}, isa {}",
      s["case"].get<std::string>(), s["state"].get<std::string>(), number(s["dx"]), whole(s["n_fluid"]),
      whole(s["n_boundary"]), s["study"].get<std::string>(), s["order"].get<std::string>(), whole(s["dim"]),
      s["precision"].get<std::string>(), s["interaction"].get<std::string>(), s["smoothing"].get<std::string>(),
      s["integrator"].get<std::string>(), number(s["dt"]), s["isa"].get<std::string>());
  for (const json& e : summary.at("environments"))
    if (e["environment"] == s["environment"]) {
      text += fmt::format("; host {}, {} cores, {}, git {}{}", e["host"].get<std::string>(), whole(e["cores"]),
                          e["compiler"].get<std::string>(), e["git"].get<std::string>(),
                          e["dirty"].get<bool>() ? " (dirty)" : "");
      break;
    }
  return wrapped(text) + "\n";
}

std::string failed_points(const json& summary) {
  if (summary.at("failed").empty()) return "";
  std::string out = "Failed points: these rows have no passed verification and are in no table\n";
  for (const json& f : summary["failed"]) {
    const json& p = f.at("point");
    out += wrapped(fmt::format("  {} M={} threads={} ({}, {}, dx {}, study {}): {} rows: {}", backend_name(p),
                               whole(p["M"]), whole(p["threads"]), p["case"].get<std::string>(),
                               p["state"].get<std::string>(), number(p["dx"]), f["study"].get<std::string>(),
                               whole(f["rows"]), f["error"].get<std::string>()));
  }
  return out + "\n";
}

std::string caveat_list(const json& summary) {
  if (summary.at("caveats").empty()) return "";
  std::string out = "Caveats: what to keep in mind with these numbers\n";
  for (const json& caveat : summary["caveats"]) out += wrapped("- " + caveat.get<std::string>());
  return out;
}

}  // namespace

std::string print_tables(const json& summary) {
  std::string out;
  const json& all = summary.at("series");
  for (std::size_t series = 0; series < all.size(); ++series)
    out += title(summary, all[series]) + summation_table(summary, series) + algorithm_table(summary, series) +
           runtime_table(summary, series) + m_table(summary, series) + phase_table(summary, series);
  return out + failed_points(summary) + caveat_list(summary);
}

}  // namespace pairsum::harness

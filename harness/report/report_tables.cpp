#include "harness/report/report_tables.hpp"

#include <algorithm>
#include <cmath>

#include "harness/report/table_cells.hpp"
#include "harness/rows/row.hpp"

namespace pairsum::harness {

report_table algorithm_table(const json& summary, std::size_t series) {
  text_table table({"runtime", "threads", "backend", "time ms", "base", "base ms", "speedup", "[low, high]"}, 3);
  const point_names names(summary);
  for (const json& e : entries(summary, "algorithm_speedup", series)) {
    const json base{{"backend", e["base_backend"]},
                    {"grid", e["grid"]},
                    {"isa", e["isa"]},
                    {"block", "none"},
                    {"granularity", e["base_granularity"]}};
    table.add({e["runtime"], whole(e["threads"]), names(e) + m_text(e["M"]), ms(number(e["time_s"])),
               names(base) + m_text(e["base_M"]), ms(number(e["base_time_s"])), fixed(e["speedup"], 3), bounds(e)});
  }
  return {"Algorithm speedup: summation time of the base over that of the backend, at the same number of threads",
          table};
}

report_table scaling_table(const json& summary, std::size_t series) {
  text_table table(
      {"backend", "M", "threads", "speedup", "[low, high]", "machine", "[low, high]", "of machine", "[low, high]"}, 1);
  const point_names names(summary);
  for (const json& e : entries(summary, "speedup", series)) {
    const json &machine = e["machine_speedup"], &share = e["of_machine"];
    if (e["threads"] == e["base_threads"] || machine["value"].is_null()) continue;
    table.add({names(e), whole(e["M"]), whole(e["threads"]), fixed(e["speedup"], 3), bounds(e),
               fixed(machine["value"], 3), bounds(machine), fixed(share["value"], 3), bounds(share)});
  }
  return {
      "Speedup over 1 thread; how many times as many multiply-adds the machine made in the same rounds, and what part "
      "of\n"
      "that the sum reaches (medians over rounds)",
      table};
}

report_table runtime_table(const json& summary, std::size_t series) {
  text_table table({"algorithm", "M", "threads", "OpenMP ms", "TBB ms", "OpenMP/TBB", "[low, high]", "faster"}, 1);
  for (const json& e : entries(summary, "runtime_comparison", series)) {
    const std::string verdict = e["verdict"] == "faster" ? "TBB" : e["verdict"] == "slower" ? "OpenMP" : "not resolved";
    table.add({e["algorithm"], whole(e["M"]), whole(e["threads"]), ms(number(e["omp_time_s"])),
               ms(number(e["tbb_time_s"])), fixed(e["ratio"], 3), bounds(e), verdict});
  }
  return {
      "OpenMP against TBB: summation time, and OpenMP's over TBB's (the base); not resolved: no difference at 95 %\n"
      "confidence over the whole table",
      table};
}

report_table m_table(const json& summary, std::size_t series) {
  text_table table(
      {"backend", "threads", "M", "sum ms", "total ms", "cells", "non-empty", "tested", "folded", "useful"}, 1);
  const point_names names(summary);
  for (const json& e : entries(summary, "m_comparison", series))
    table.add({names(e), whole(e["threads"]), whole(e["M"]), ms(number(e["time_s"])), ms(number(e["total_s"])),
               whole(e["cells"]), whole(e["cells_nonempty"]), whole(e["pairs_tested"]), percent(e["collision_share"]),
               fixed(e["useful_pair_ratio"], 4)});
  return {
      "Comparison over M: median times per step, cells, distance tests, those due to folded cells, and pairs found per "
      "test",
      table};
}

report_table phase_table(const json& summary, std::size_t series) {
  std::vector<std::string> header{"backend", "M", "thr"};
  for (const phase_member& phase : phase_members) {
    const std::string name = phase.name;
    header.push_back(name.substr(0, name.size() - 2));
  }
  text_table table(header, 1);
  const point_names names(summary);
  for (const json& entry : entries(summary, "points", series)) {
    const json& p = entry.at("point");
    std::vector<std::string> cells{names(p), whole(p["M"]), whole(p["threads"])};
    const double total = number(entry["phases"]["total_s"]["median"]);
    for (const phase_member& phase : phase_members) {
      const double time = number(entry["phases"][phase.name]["median"]);
      const bool share = std::string(phase.name) != "total_s" && std::isfinite(time / total);
      cells.push_back(share ? fmt::format("{} {:>3.0f}%", ms(time), 100 * time / total) : ms(time));
    }
    table.add(cells);
  }
  return {"Phases per step: median ms and share of the total (pair lists: prepare makes the list, sum sweeps it)",
          table};
}

/// One row per point, for Markdown.
report_table summation_table(const json& summary, std::size_t series) {
  text_table table({"backend", "M", "threads", "sum ms", "[low, high]", "speedup", "efficiency", "ns/pair", "rounds"},
                   1);
  const std::vector<json> speedups = entries(summary, "speedup", series);
  const point_names names(summary);
  for (const json& entry : entries(summary, "points", series)) {
    const json& p = entry.at("point");
    const json& sum = entry.at("phases").at("sum_s");
    const auto own = std::ranges::find_if(speedups, [&](const json& s) { return same_point(s, p); });
    const bool known = own != speedups.end();
    table.add({names(p), whole(p["M"]), whole(p["threads"]), ms(number(sum["median"])),
               sum["low"].is_null() ? "no interval"
                                    : fmt::format("[{}, {}]", ms(number(sum["low"])), ms(number(sum["high"]))),
               known ? fixed((*own)["speedup"], 2) : "-", known ? percent((*own)["efficiency"]) : "-",
               fixed(entry["ns_per_pair"], 3), whole(entry["rounds"])});
  }
  return {"Summation time per step; speedup and efficiency over the same backend on 1 thread", table};
}

report_table bound_table(const json& summary, std::size_t series) {
  text_table table(
      {"backend", "M", "threads", "sum ms", "bound ms", "of bound", "set by", "flop/byte", "Gflop/s", "waiting"}, 1);
  const point_names names(summary);
  for (const json& entry : entries(summary, "points", series)) {
    const json &p = entry.at("point"), &m = entry.at("model"), &w = entry.at("passes");
    if (!m.is_object() && !w.is_object()) continue;
    const bool known = m.is_object();
    table.add({names(p), whole(p["M"]), whole(p["threads"]), ms(number(entry["phases"]["sum_s"]["median"])),
               known ? ms(number(m["bound_s"])) : "-", known ? percent(m["share_of_bound"]) : "-",
               known ? m["limited_by"].get<std::string>() : "-", known ? fixed(m["intensity"], 1) : "-",
               known ? fmt::format("{:.2f}", 1e-9 * number(m["achieved_flops_per_s"])) : "-",
               w.is_object() ? percent(w["wait_share"]) : "-"});
  }
  return {
      "Against the least time that arithmetic or memory bandwidth allows, and threads' time spent waiting at barriers",
      table};
}

report_table build_table(const json& summary, std::size_t series) {
  text_table table({"backend", "M", "threads", "base ms", "ms", "base/this", "[low, high]", "this is"}, 1);
  const point_names names(summary);
  std::string base, own;
  for (const json& e : entries(summary, "compiler_comparison", series)) {
    base = e["base_compiler"];
    own = e["compiler"];
    table.add({names(e), whole(e["M"]), whole(e["threads"]), ms(number(e["base_time_s"])), ms(number(e["time_s"])),
               fixed(e["ratio"], 3), bounds(e), e["verdict"].get<std::string>()});
  }
  return {fmt::format("Builds: summation time of this one, {}\nand of the base, {}", own, base), table};
}

report_table self_test_table(const json& summary) {
  text_table table({"what", "backend", "state", "dx", "M", "threads", "expected", "ratio", "[low, high]", "holds"}, 3);
  for (const json& e : summary.at("self_test"))
    table.add({e["what"], e["backend"], e["state"], fmt::format("{}", number(e["dx"])), whole(e["M"]),
               whole(e["threads"]), fixed(e["expected"], 2), fixed(e["ratio"], 4),
               e["low"].is_null() ? "-" : fmt::format("[{:.4f}, {:.4f}]", number(e["low"]), number(e["high"])),
               e["holds"].get<bool>() ? "yes" : "NO"});
  return {"Self-test: summation time over that of the base against what is known (95 % over the whole table)", table};
}

}  // namespace pairsum::harness

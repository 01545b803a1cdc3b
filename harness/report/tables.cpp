#include "harness/report/tables.hpp"

#include <algorithm>

#include "harness/report/report_tables.hpp"
#include "harness/report/strategy_tables.hpp"
#include "harness/report/table_cells.hpp"
#include "harness/rows/point_words.hpp"

namespace pairsum::harness {
namespace {

std::string answers(const json& summary, const char* between) {
  std::string text;
  if (summary.at("answer").is_object())
    text +=
        wrapped(summary["answer"]["text"].get<std::string>() + " " + summary["answer"]["details"].get<std::string>()) +
        between;
  for (const json& q : summary.at("questions"))
    text += wrapped(q["question"].get<std::string>() + " " + q["answer"].get<std::string>()) + between;
  return text;
}

std::string as_text(const report_table& t) { return t.table.empty() ? "" : t.caption + "\n" + t.table.text() + "\n"; }

std::string as_markdown(const report_table& t) {
  if (t.table.empty()) return "";
  std::string caption = t.caption;
  std::ranges::replace(caption, '\n', ' ');
  return caption + "\n\n" + t.table.markdown() + "\n";
}

std::string title(const json& s) {
  return fmt::format("{}, {}, dx {}", s["case"].get<std::string>(), s["state"].get<std::string>(), number(s["dx"]));
}

std::string details(const json& summary, const json& s) {
  std::string text = fmt::format("{} fluid and {} boundary particles; study {}, order {}, {}D, {}, {}, {}, {}, dt {}",
                                 whole(s["n_fluid"]), whole(s["n_boundary"]), s["study"].get<std::string>(),
                                 s["order"].get<std::string>(), whole(s["dim"]), s["precision"].get<std::string>(),
                                 s["interaction"].get<std::string>(), s["smoothing"].get<std::string>(),
                                 s["integrator"].get<std::string>(), number(s["dt"]));
  for (const json& e : summary.at("environments"))
    if (e["environment"] == s["environment"]) {
      text += fmt::format("; host {}, {} cores, {}, git {}{}", e["host"].get<std::string>(), whole(e["cores"]),
                          e["compiler"].get<std::string>(), e["git"].get<std::string>(),
                          e["dirty"].get<bool>() ? " (dirty)" : "");
      break;
    }
  return text;
}

template <class Print>
std::string tables_of(const json& summary, std::size_t series, Print print) {
  return print(algorithm_table(summary, series)) + print(scaling_table(summary, series)) +
         print(runtime_table(summary, series)) + print(m_table(summary, series)) + print(bound_table(summary, series)) +
         print(phase_table(summary, series)) + print(strategy_table(summary, series)) +
         print(build_table(summary, series));
}

template <class Print>
std::string tables_of_all(const json& summary, Print print) {
  return print(strategies_table(summary)) + print(shifts_table(summary)) + breakdown_list(summary) +
         print(self_test_table(summary));
}

std::string failed_points(const json& summary) {
  if (summary.at("failed").empty()) return "";
  std::string out = "Failed points: these rows have no passed verification and are in no table\n";
  for (const json& f : summary["failed"]) {
    const json& p = f.at("point");
    out += wrapped(fmt::format("  {} ({}, {}, dx {}, study {}): {} rows: {}", place_words(p.get<point>()),
                               p["case"].get<std::string>(), p["state"].get<std::string>(), number(p["dx"]),
                               f["study"].get<std::string>(), whole(f["rows"]), f["error"].get<std::string>()));
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
  std::string out = answers(summary, "\n");
  const json& all = summary.at("series");
  for (std::size_t series = 0; series < all.size(); ++series)
    out += wrapped("== " + title(all[series]) + ": " + details(summary, all[series])) + "\n" +
           summation_text(summary, series) + tables_of(summary, series, as_text);
  return out + tables_of_all(summary, as_text) + failed_points(summary) + caveat_list(summary);
}

std::string print_markdown(const json& summary) {
  std::string out = "# " + summary.at("title").get<std::string>() + "\n\n" + answers(summary, "\n");
  const json& all = summary.at("series");
  for (std::size_t series = 0; series < all.size(); ++series)
    out += "## " + title(all[series]) + "\n\n" + wrapped(details(summary, all[series])) + "\n" +
           as_markdown(summation_table(summary, series)) + tables_of(summary, series, as_markdown);
  out += tables_of_all(summary, as_markdown);
  const std::string rest = failed_points(summary) + caveat_list(summary);
  return out + (rest.empty() ? "" : "```text\n" + rest + "```\n");
}

}  // namespace pairsum::harness

#include "harness/report/strategy_tables.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/report/table_cells.hpp"

namespace pairsum::harness {
namespace {

/// "1.23 [1.20, 1.26]", or "-" where it is not known.
std::string with_bounds(const json& e, const char* value = "value") {
  if (!e.is_object()) return "-";
  if (e.at("low").is_null()) return fixed(e.at(value), 2);
  return fmt::format("{} [{}, {}]", fixed(e.at(value), 2), fixed(e.at("low"), 2), fixed(e.at("high"), 2));
}

std::string mebibytes(const json& bytes) {
  return bytes.is_number() ? fmt::format("{:.1f}", number(bytes) / (1 << 20)) : "-";
}

std::string word(const json& text) { return text.is_string() ? text.get<std::string>() : "-"; }

std::string yes_no(const json& flag) { return flag.is_boolean() ? (flag.get<bool>() ? "yes" : "no") : "-"; }

/// The entry of the same backend in the series' ladder of one thread; null if there is none.
json on_one_thread(const std::vector<json>& ladder, const json& backend) {
  const auto at = std::ranges::find_if(
      ladder, [&](const json& e) { return e.at("backend") == backend && e.at("at") == "one_thread"; });
  return at == ladder.end() ? json() : *at;
}

}  // namespace

report_table strategy_table(const json& summary, std::size_t series) {
  text_table table({"backend", "threads", "ms", "base/this", "1 thread over serial sweep", "efficiency", "waiting",
                    "extra MiB", "rank"},
                   1);
  const std::vector<json> ladder = entries(summary, "strategy_ladder", series);
  const bool parallel = std::ranges::any_of(ladder, [](const json& e) { return e.at("at") == "most_threads"; });
  std::string base;
  for (const json& e : ladder) {
    if (parallel && e.at("at") != "most_threads") continue;
    const json one = on_one_thread(ladder, e.at("backend"));
    base = fmt::format("{} on {} threads, {} ms", word(e.at("base_backend")), whole(e.at("base_threads")),
                       ms(number(e.at("base_time_s"))));
    table.add({word(e.at("backend")) + m_text(e.at("M")), whole(e.at("threads")), ms(number(e.at("time_s"))),
               with_bounds(e, "ratio"), with_bounds(one.is_object() ? one.at("over_serial") : json()),
               with_bounds(e.at("efficiency")), percent(e.at("wait_share")), mebibytes(e.at("extra_bytes")),
               fmt::format("{} of {}", whole(e.at("rank")), whole(e.at("of")))});
  }
  return {fmt::format("Strategies: prepare, zero, sum and reduce together, each backend at its most threads; base {};\n"
                      "memory beyond that of the leanest",
                      base),
          table};
}

report_table strategies_table(const json& summary) {
  text_table table({"backend", "threads", "conflicts", "pairs", "same bits", "also"}, 6);
  for (const json& e : summary.at("strategies"))
    table.add({word(e.at("backend")), word(e.at("runtime")), word(e.at("conflicts")),
               e.at("symmetric").is_null()     ? "-"
               : e.at("symmetric").get<bool>() ? "once"
                                               : "twice",
               yes_no(e.at("deterministic")), word(e.at("aliases"))});
  return {"Strategies: how each backend keeps threads apart, whether its bits are the same for every number of threads",
          table};
}

std::string breakdown_list(const json& summary) {
  std::string out;
  for (const json& e : summary.at("strategies"))
    if (e.at("breaks_down").is_string())
      out += wrapped("- " + word(e.at("backend")) + ": " + word(e.at("breaks_down")));
  return out.empty() ? "" : "Where strategies break down, of what was measured\n" + out + "\n";
}

report_table shifts_table(const json& summary) {
  text_table table({"in", "after", "backend", "threads", "ratio", "here it is", "rank", "rank before"}, 3);
  for (const json& e : summary.at("strategy_shifts"))
    table.add({word(e.at("world")), word(e.at("base_world")), word(e.at("backend")), whole(e.at("threads")),
               with_bounds(e, "ratio"), word(e.at("verdict")),
               fmt::format("{} of {}", whole(e.at("rank")), whole(e.at("of"))),
               fmt::format("{} of {}", whole(e.at("base_rank")), whole(e.at("base_of")))});
  return {
      "Strategies from one world to another: time over that of the base there, over the same here (below 1 it fares "
      "worse here)",
      table};
}

}  // namespace pairsum::harness

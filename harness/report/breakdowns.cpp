#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include <pairsum/core/names.hpp>
#include "harness/report/strategies.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

// What counts as breaking down.
constexpr double poor_efficiency = 0.75;    // the interval lies below
constexpr double dear_on_one_thread = 1.5;  // times the serial sweep: the interval lies above
constexpr double fares_worse = 1.25;        // times as slow, against the base, as elsewhere: resolved
constexpr double much_memory = 100;         // bytes a particle more than the leanest

bool has_bounds(const json& e) { return e.is_object() && e.at("low").is_number() && e.at("high").is_number(); }

std::string bounds_text(double low, double high) { return fmt::format("[{:.2f}, {:.2f}]", low, high); }

/// The entry of a table for which `value` is largest among those where it is above 0; null if there is none.
template <class Value>
json worst_of(const json& table, const std::string& backend, Value value) {
  json worst;
  double most = 0;
  for (const json& e : table)
    if (e.at("backend") == backend && value(e) > most) {
      most = value(e);
      worst = e;
    }
  return worst;
}

std::string text_of(const json& e, const char* key) { return e.at(key).get<std::string>(); }

void add_threads(const json& ladder, const std::string& backend, std::vector<std::string>& found) {
  const json e = worst_of(ladder, backend, [](const json& entry) {
    const json& own = entry.at("efficiency");
    return has_bounds(own) ? poor_efficiency / own.at("high").get<double>() - 1 : 0;
  });
  if (e.is_null()) return;
  const json& own = e.at("efficiency");
  found.push_back(fmt::format("{} threads: efficiency {:.2f} {} ({})", e.at("threads").get<int>(),
                              own.at("value").get<double>(), bounds_text(own.at("low"), own.at("high")),
                              text_of(e, "world")));
}

void add_one_thread(const json& ladder, const std::string& backend, std::vector<std::string>& found) {
  const json e = worst_of(ladder, backend, [](const json& entry) {
    const json& own = entry.at("over_serial");
    return has_bounds(own) ? own.at("low").get<double>() / dear_on_one_thread - 1 : 0;
  });
  if (e.is_null()) return;
  const json& own = e.at("over_serial");
  found.push_back(fmt::format("1 thread: {:.2f} {} times the serial sweep ({})", own.at("value").get<double>(),
                              bounds_text(own.at("low"), own.at("high")), text_of(e, "world")));
}

void add_shifts(const json& shifts, const std::string& backend, std::vector<std::string>& found) {
  for (const json& e : shifts) {
    if (e.at("backend") != backend || e.at("verdict") != "slower" || !has_bounds(e)) continue;
    const double times = 1 / e.at("ratio").get<double>();
    if (times < fares_worse) continue;
    found.push_back(fmt::format("{}: against {} {:.2f} {} times as slow as in {}; rank {} of {} after {} of {}",
                                text_of(e, "world"), text_of(e, "base_backend"), times,
                                bounds_text(1 / e.at("high").get<double>(), 1 / e.at("low").get<double>()),
                                text_of(e, "base_world"), e.at("rank").get<int>(), e.at("of").get<int>(),
                                e.at("base_rank").get<int>(), e.at("base_of").get<int>()));
  }
}

void add_memory(const json& ladder, const std::string& backend, std::vector<std::string>& found) {
  const json e = worst_of(ladder, backend, [](const json& entry) {
    const json& own = entry.at("extra_bytes_per_particle");
    return own.is_number() ? own.get<double>() / much_memory - 1 : 0;
  });
  if (e.is_null()) return;
  found.push_back(fmt::format("memory: {:.0f} bytes a particle more than the leanest, on {} thread{} ({})",
                              e.at("extra_bytes_per_particle").get<double>(), e.at("threads").get<int>(),
                              e.at("threads") == 1 ? "" : "s", text_of(e, "world")));
}

}  // namespace

std::vector<std::string> breakdowns(const json& tables, const std::string& backend) {
  std::vector<std::string> found;
  const json& ladder = tables.at("strategy_ladder");
  add_one_thread(ladder, backend, found);
  add_threads(ladder, backend, found);
  add_shifts(tables.at("strategy_shifts"), backend, found);
  add_memory(ladder, backend, found);
  return found;
}

json strategies(const json& tables) {
  std::set<std::string> backends;
  for (const json& e : tables.at("strategy_ladder")) backends.insert(e.at("backend").get<std::string>());
  json all = json::array();
  for (const std::string& backend : backends) {
    const backend_traits* const t = traits_of(backend);
    const auto said = [&](auto value) { return t != nullptr ? json(value(*t)) : json(nullptr); };
    std::string where;
    for (const std::string& text : breakdowns(tables, backend)) where += (where.empty() ? "" : "; ") + text;
    all.push_back({{"backend", backend},
                   {"conflicts", said([](const auto& b) { return name_of(b.conflicts); })},
                   {"runtime", said([](const auto& b) { return name_of(b.threads); })},
                   {"aliases", said([](const auto& b) { return b.aliases; })},
                   {"description", said([](const auto& b) { return b.description; })},
                   {"symmetric", said([](const auto& b) { return b.symmetric; })},
                   {"deterministic", said([](const auto& b) { return b.deterministic; })},
                   {"breaks_down", where.empty() ? json(nullptr) : json(where)}});
  }
  return all;
}

}  // namespace pairsum::harness

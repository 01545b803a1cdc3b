#pragma once

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/rows/variant_names.hpp"

/// How values of a summary look in tables.
namespace pairsum::harness {

using nlohmann::json;

inline double number(const json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

inline std::string fixed(const json& value, int digits) {
  return value.is_number() ? fmt::format("{:.{}f}", value.get<double>(), digits) : "-";
}

inline std::string percent(const json& value) {
  return value.is_number() ? fmt::format("{:.1f} %", 100 * value.get<double>()) : "-";
}

inline std::string whole(const json& value) { return value.is_null() ? "-" : value.dump(); }

inline std::string bounds(const json& entry) {
  if (entry.at("low").is_null()) return "no interval";
  return fmt::format("[{:.3f}, {:.3f}]", number(entry["low"]), number(entry["high"]));
}

/// The entries of one array of the summary that belong to a series.
inline std::vector<json> entries(const json& summary, const char* name, std::size_t series) {
  std::vector<json> found;
  for (const json& entry : summary.at(name))
    if (entry.at("series") == series) found.push_back(entry);
  return found;
}

inline bool same_point(const json& a, const json& b) {
  for (const char* key : {"backend", "grid", "granularity", "isa", "block", "M", "threads"})
    if (a.at(key) != b.at(key)) return false;
  return true;
}

/// The names of the points of a summary; a table's entry has its keys, too.
class point_names {
 public:
  explicit point_names(const json& summary) {
    for (const json& e : summary.at("points")) names_.add(words(e.at("point")));
  }
  std::string operator()(const json& place) const { return names_(words(place)); }

 private:
  static point words(const json& place) {
    point p;
    p.backend = place.at("backend");
    p.grid = place.at("grid");
    p.isa = place.at("isa");
    p.block = place.at("block");
    p.granularity = place.at("granularity");
    return p;
  }
  variant_names names_;
};

/// " M=6", or nothing where the grid takes no M.
inline std::string m_text(const json& M) { return M.is_null() ? "" : " M=" + M.dump(); }

}  // namespace pairsum::harness

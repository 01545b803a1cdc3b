#pragma once

#include <fmt/format.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

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

inline std::string backend_name(const json& point) {
  const std::string name = point.at("backend"), grid = point.at("grid");
  return grid == "hashed_grid" || grid.empty() ? name : name + "/" + grid;
}

inline bool same_point(const json& a, const json& b) {
  for (const char* key : {"backend", "grid", "granularity", "M", "threads"})
    if (a.at(key) != b.at(key)) return false;
  return true;
}

/// Names of points: the backend's, with the granularity if it was measured with several.
class point_names {
 public:
  explicit point_names(const json& summary) {
    for (const json& e : summary.at("points"))
      granularities_[backend_name(e["point"])].insert(e["point"]["granularity"].get<std::string>());
  }
  std::string operator()(const json& point) const {
    const std::string name = backend_name(point);
    const auto at = granularities_.find(name);
    const bool several = at != granularities_.end() && at->second.size() > 1;
    return several ? name + " " + point.at("granularity").get<std::string>() : name;
  }

 private:
  std::map<std::string, std::set<std::string>> granularities_;
};

}  // namespace pairsum::harness

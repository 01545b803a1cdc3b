#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "harness/report/tables.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// The scalar members of an object, nested ones too, by their full names.
void flatten(const json& object, const std::string& prefix, std::vector<std::pair<std::string, json>>& cells) {
  for (const auto& item : object.items()) {
    if (item.value().is_object())
      flatten(item.value(), prefix + item.key() + ".", cells);
    else if (!item.value().is_array())
      cells.emplace_back(prefix + item.key(), item.value());
  }
}

std::string cell(const json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  const std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string print_csv(const json& entries) {
  std::vector<std::string> columns;
  std::vector<std::vector<std::pair<std::string, json>>> rows;
  for (const json& entry : entries) {
    rows.emplace_back();
    flatten(entry, "", rows.back());
    for (const auto& [name, value] : rows.back())
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
  }
  std::string out;
  for (const std::string& name : columns) out += (out.empty() ? "" : ",") + cell(json(name));
  out += "\n";
  for (const auto& row : rows) {
    std::string line;
    for (const std::string& name : columns) {
      if (&name != &columns.front()) line += ",";
      for (const auto& [own, value] : row)
        if (own == name) line += cell(value);
    }
    out += line + "\n";
  }
  return out;
}

}  // namespace pairsum::harness

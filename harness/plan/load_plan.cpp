#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include "harness/plan/study.hpp"

namespace pairsum::harness {

nlohmann::json load_plan(const std::string& word) {
  if (!word.ends_with(".json") && word.find('/') == word.npos) {
    std::vector<std::string_view> names;
    for (const shipped_plan& p : shipped_plans()) {
      if (p.name == word) return nlohmann::json::parse(p.json);
      names.push_back(p.name);
    }
    throw unknown_name("plan", word, names);
  }
  std::error_code code;
  if (std::filesystem::is_directory(word, code)) throw error(word + ": is a folder, should be a plan (a JSON file)");
  std::ifstream file(word);
  if (!file) throw error(fmt::format("{}: cannot be read, should be a plan (a JSON file)", word));
  try {
    return nlohmann::json::parse(file);
  } catch (const nlohmann::json::exception& e) {
    throw error(fmt::format("{}: is no whole JSON (byte {})", word,
                            dynamic_cast<const nlohmann::json::parse_error*>(&e) != nullptr
                                ? static_cast<const nlohmann::json::parse_error&>(e).byte
                                : 0));
  }
}

}  // namespace pairsum::harness

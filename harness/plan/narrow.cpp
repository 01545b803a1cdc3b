#include "harness/plan/narrow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include "harness/plan/levels.hpp"
#include "harness/plan/words.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// The values of a level, whether it takes one or a list.
std::vector<json> values_of(const run_request& r, const std::string& key) {
  const json value = levels_json(r).value(key, json());
  if (value.is_null()) return {};
  return value.is_array() ? value.get<std::vector<json>>() : std::vector<json>{value};
}

void add_new(std::vector<json>& all, const std::vector<json>& more) {
  for (const json& v : more)
    if (std::ranges::find(all, v) == all.end()) all.push_back(v);
}

std::string text_of(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

error not_in_plan(const study_plan& plan, const std::string& key, const json& value, const std::vector<json>& there) {
  std::vector<std::string> words;
  for (const json& v : there) words.push_back(text_of(v));
  return error(fmt::format("the plan {} has no {} {};{} it has {}", plan.study, key, text_of(value),
                           value.is_string() ? hint_for(text_of(value), words) : "", join(words)));
}

/// What "backend=a,b" names, after it was looked up in the plan's values.
std::vector<json> wanted_values(const study_plan& plan, const std::string& key, const std::string& text, int cores) {
  std::vector<json> there, wanted;
  for (const part_plan& p : plan.parts) add_new(there, values_of(p.request, key));
  for (const std::string& word : parse_words("--only " + key, text)) {
    run_request read;
    read_level(read, key, word, cores, "--only " + key);
    for (const json& v : values_of(read, key)) {
      if (std::ranges::find(there, v) == there.end()) throw not_in_plan(plan, key, v, there);
      add_new(wanted, std::vector<json>(1, v));
    }
  }
  return wanted;
}

}  // namespace

void narrow(study_plan& plan, const std::vector<std::string>& only, int cores) {
  std::map<std::string, std::vector<json>> wanted;
  for (const std::string& text : only) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos)
      throw error(fmt::format("--only takes a level with its values, like backend=naive, not \"{}\"", text));
    const std::string key = text.substr(0, equals);
    check_word("level of --only", key, level_words());
    add_new(wanted[key], wanted_values(plan, key, text.substr(equals + 1), cores));
  }
  std::vector<part_plan> kept;
  for (part_plan& part : plan.parts) {
    bool left = true;
    for (const auto& [key, values] : wanted) {
      json own = json::array();
      for (const json& v : values_of(part.request, key))
        if (std::ranges::find(values, v) != values.end()) own.push_back(v);
      left = left && !own.empty();
      if (left) read_level(part.request, key, own, cores);
    }
    if (left) kept.push_back(std::move(part));
  }
  if (kept.empty()) throw error(fmt::format("no part of the plan {} has {} together", plan.study, join(only)));
  plan.parts = std::move(kept);
}

}  // namespace pairsum::harness

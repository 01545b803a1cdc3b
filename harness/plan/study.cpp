#include "harness/plan/study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include "harness/plan/levels.hpp"
#include "harness/plan/variants.hpp"
#include "harness/rows/fields.hpp"
#include "harness/rows/hash_text.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

[[noreturn]] void wrong(const std::string& key, const std::string& right, const json& found) {
  throw error(fmt::format("the plan's \"{}\" should be {}, is {}", key, right, found.dump()));
}

error unknown_key(const std::string& key, const std::vector<std::string>& keys) {
  return error(fmt::format("the plan's key \"{}\" is not known;{} there are {}", key, hint_for(key, keys), join(keys)));
}

/// The keys of a part: its own, and levels.
std::vector<std::string> part_keys() {
  std::vector<std::string> keys{"name", "reason", "rounds", "half_width", "share"};
  for (const std::string& level : level_words()) keys.push_back(level);
  return keys;
}

double number_of(const json& value, const std::string& key, double least) {
  if (!value.is_number() || !(value.get<double>() >= least)) wrong(key, fmt::format("a number from {}", least), value);
  return value.get<double>();
}

int whole_of(const json& value, const std::string& key, int least, int most) {
  if (!value.is_number_integer() || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
    wrong(key, fmt::format("a whole number from {} to {}", least, most), value);
  return value.get<int>();
}

std::string text_of(const json& value, const std::string& key) {
  if (!value.is_string()) wrong(key, "a text", value);
  const auto text = value.get<std::string>();
  if (has_controls(text)) wrong(key, "a text without control characters", value);
  return text;
}

bool flag_of(const json& value, const std::string& key) {
  if (!value.is_boolean()) wrong(key, "true or false", value);
  return value.get<bool>();
}

/// "rounds": a number, or [least, most].
void read_rounds(part_plan& part, const json& value) {
  if (value.is_array() && value.size() == 2) {
    part.least_rounds = whole_of(value[0], "rounds", 1, rounds_limit);
    part.most_rounds = whole_of(value[1], "rounds", part.least_rounds, rounds_limit);
  } else {
    part.least_rounds = part.most_rounds = whole_of(value, "rounds", 1, rounds_limit);
  }
}

/// One key of a part or of the defaults.
void read_key(part_plan& part, const std::string& key, const json& value, int cores) {
  if (key == "reason")
    part.reason = text_of(value, key);
  else if (key == "rounds")
    read_rounds(part, value);
  else if (key == "half_width")
    part.half_width = number_of(value, key, 0);
  else if (key == "share")
    part.share = number_of(value, key, 1e-9);
  else if (!read_level(part.request, key, value, cores))
    throw unknown_key(key, part_keys());
}

part_plan read_part(const json& value, part_plan part, int cores) {
  if (!value.is_object()) wrong("parts", "a list of objects", value);
  for (const auto& item : value.items()) {
    if (item.key() == "name")
      part.request.part = text_of(item.value(), "name");
    else
      read_key(part, item.key(), item.value(), cores);
  }
  if (part.request.part.empty()) throw error("each part of a plan needs a \"name\"");
  return part;
}

}  // namespace

study_plan parse_plan(const json& j, int cores) {
  if (!j.is_object()) throw error("a plan should be a JSON object, is " + std::string(j.type_name()));
  if (j.value("schema", json()) != plan_schema)
    wrong("schema", fmt::format("\"{}\"", plan_schema), j.value("schema", json()));
  study_plan plan;
  part_plan defaults;
  defaults.request.part.clear();
  json parts = json::array();
  for (const auto& item : j.items()) {
    const std::string& key = item.key();
    const json& value = item.value();
    if (key == "schema") continue;
    if (key == "study")
      plan.study = text_of(value, key);
    else if (key == "title")
      plan.title = text_of(value, key);
    else if (key == "budget_s")
      plan.budget_s = number_of(value, key, 0);
    else if (key == "seed")
      read_level(defaults.request, "seed", value, cores);
    else if (key == "peaks")
      plan.peaks = flag_of(value, key);
    else if (key == "self_test")
      plan.self_test = flag_of(value, key);
    else if (key == "builds")
      plan.builds = whole_of(value, key, 1, 9);
    else if (key == "parts")
      parts = value;
    else if (key != "defaults")
      throw unknown_key(
          key, {"schema", "study", "title", "budget_s", "seed", "peaks", "self_test", "builds", "defaults", "parts"});
  }
  if (plan.study.empty()) wrong("study", "the name of the study", json(plan.study));
  if (!parts.is_array() || parts.empty()) wrong("parts", "a list of at least one part", parts);
  defaults.request.study = plan.study;
  if (const auto at = j.find("defaults"); at != j.end()) {
    if (!at->is_object()) wrong("defaults", "an object", *at);
    for (const auto& item : at->items()) read_key(defaults, item.key(), item.value(), cores);
  }
  std::set<std::string> names;
  for (const json& part : parts) {
    plan.parts.push_back(read_part(part, defaults, cores));
    if (!names.insert(plan.parts.back().request.part).second)
      throw error(fmt::format("two parts of the plan are named \"{}\"", plan.parts.back().request.part));
  }
  return plan;
}

json plan_json(const study_plan& plan) {
  json j{{"schema", plan_schema}, {"study", plan.study},         {"title", plan.title},   {"budget_s", plan.budget_s},
         {"peaks", plan.peaks},   {"self_test", plan.self_test}, {"builds", plan.builds}, {"parts", json::array()}};
  for (const part_plan& p : plan.parts) {
    json part = levels_json(p.request);
    part["name"] = p.request.part;
    part["reason"] = p.reason;
    part["rounds"] = {p.least_rounds, p.most_rounds};
    part["half_width"] = p.half_width;
    part["share"] = p.share;
    j["parts"].push_back(part);
  }
  return j;
}

std::string plan_hash(const study_plan& plan) {
  json j = plan_json(plan);
  j.erase("budget_s");
  return hash_text(j.dump());
}

void check_plan(const study_plan& plan, const registry& all) {
  for (const part_plan& p : plan.parts) check_request(p.request, all);
}

plan_here measurable(study_plan plan, const registry& all) {
  plan_here here{std::move(plan), {}};
  std::erase_if(here.plan.parts, [&](part_plan& p) {
    if (auto why = leave_out_unavailable(p.request, all); !why.empty()) here.left_out[p.request.part] = std::move(why);
    return p.request.backends.empty();
  });
  check_plan(here.plan, all);
  return here;
}

std::set<std::pair<int, std::string>> peaks_of(const study_plan& plan, const registry& all) {
  std::set<std::pair<int, std::string>> wanted;
  for (const part_plan& part : plan.parts)
    for (const world_plan& points : expand(part.request, all))
      for (const point& p : points) wanted.emplace(p.threads, p.precision);
  return wanted;
}

}  // namespace pairsum::harness

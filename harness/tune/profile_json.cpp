#include "harness/tune/profile_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include "harness/environment/environment.hpp"
#include "harness/environment/machine.hpp"
#include "harness/plan/levels.hpp"
#include "harness/rows/fields.hpp"
#include "harness/rows/json_file.hpp"
#include "harness/tune/candidates.hpp"
#include "harness/tune/winner.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// The levels that make the case.
constexpr std::string_view case_levels[] = {"case",  "dx",          "state",     "dim",     "H",
                                            "order", "interaction", "smoothing", "outside", "seed"};

/// Is the level one that only particles of files have?
bool is_of_files(std::string_view key) {
  return key == "particles" || key == "particles_hash" ||
         std::ranges::find(particle_hints(), key, &particle_hint::word) != particle_hints().end();
}

std::vector<std::string> keys_of_case() {
  std::vector<std::string> keys(std::begin(case_levels), std::end(case_levels));
  for (const std::string& key : level_words())
    if (is_of_files(key)) keys.push_back(key);
  return keys;
}

json bound(const std::optional<interval>& bounds, double interval::*side) {
  return bounds ? json((*bounds).*side) : json(nullptr);
}

constexpr const char* kind = "a profile of pairsum tune";

saved_profile read(const json& j) {
  saved_profile p;
  fields from(j);
  from.literal("schema", profile_schema);
  p.words = from.text("words");
  const profile words = parse_profile(p.words);
  fields made_for = from.nested("case");
  for (const std::string& key : keys_of_case())
    if (made_for.has(key.c_str()) || !is_of_files(key))
      read_level(p.levels, key, made_for.at(key.c_str()), 0, "its " + key);
  made_for.finish();
  fields machine = from.nested("machine");
  p.host = machine.text("host");
  p.cpu = machine.text("cpu");
  p.cores = machine.integer("cores", 1);
  machine.finish();
  for (const char* key : {"n_fluid", "n_boundary", "rounds"}) from.count(key);
  for (const char* key : {"time_s", "low", "high"}) from.amount_or_null(key);
  for (const char* key : {"phase", "git", "utc"}) from.text(key);
  from.finish();
  p.levels.backends = {words.words.backend};
  p.levels.grids = {words.words.grid};
  p.levels.M = {words.words.M};
  p.levels.isas = {words.words.isa};
  p.levels.blocks = {words.words.block};
  p.levels.precisions = {words.words.precision};
  p.levels.granularities = {words.granularity};
  p.levels.threads = {words.threads};
  return p;
}

}  // namespace

json case_json(const run_request& r) {
  const json levels = levels_json(r);
  json made_for;
  for (const std::string& key : keys_of_case())
    if (levels.contains(key)) made_for[key] = levels.at(key);
  return made_for;
}

json profile_json(const tune_request& r, const tune_result& result, const registry& all) {
  const point& best = result.points.at(result.winner.value());
  const tuned_time time = time_of(result);
  const environment_row here = describe_environment("tune", "", "");
  return {{"schema", profile_schema},
          {"words", profile_words(best, all)},
          {"case", case_json(r.levels)},
          {"n_fluid", best.n_fluid},
          {"n_boundary", best.n_boundary},
          {"machine", {{"host", here.host}, {"cpu", here.cpu}, {"cores", usable_cores()}}},
          {"git", here.git},
          {"utc", here.utc},
          {"phase", r.phase},
          {"time_s", time.seconds},
          {"low", bound(time.bounds, &interval::low)},
          {"high", bound(time.bounds, &interval::high)},
          {"rounds", time.rounds}};
}

saved_profile read_profile(const std::string& path) {
  const json j = read_json_file(path, kind);
  try {
    if (!j.is_object()) throw error("should be a JSON object");
    return read(j);
  } catch (const error& e) {
    throw error(fmt::format("{}: is no profile of pairsum tune: {}", path, e.what()));
  }
}

bool is_profile(const std::string& path) {
  try {
    const json j = read_json_file(path, kind);
    const json schema = j.is_object() ? j.value("schema", json()) : json();
    return schema.is_string() && schema.get<std::string>().starts_with("pairsum.profile/");
  } catch (const error&) {
    return false;
  }
}

bool profile_says(std::string_view level) {
  constexpr std::string_view words[] = {"backend", "grid", "M", "isa", "block", "precision", "threads", "granularity"};
  return std::ranges::find(words, level) != std::end(words) ||
         std::ranges::find(case_levels, level) != std::end(case_levels) || is_of_files(level);
}

std::string differences(const saved_profile& p) {
  const machine here = describe_machine();
  if (p.cpu == here.cpu && p.cores == usable_cores()) return "";
  return fmt::format("the profile was made on {} ({}, {} cores); what is fastest here may be something else", p.host,
                     p.cpu, p.cores);
}

}  // namespace pairsum::harness

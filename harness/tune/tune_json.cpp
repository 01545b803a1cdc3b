#include "harness/tune/tune_json.hpp"

#include <nlohmann/json.hpp>

#include "harness/environment/environment.hpp"
#include "harness/rows/json_parts.hpp"
#include "harness/tune/candidates.hpp"
#include "harness/tune/ladder.hpp"
#include "harness/tune/profile_json.hpp"
#include "harness/tune/winner.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

json candidate_json(const point& p, const contestant& c, const registry& all) {
  return {{"words", profile_words(p, all)},
          {"backend", p.backend},
          {"grid", p.grid},
          {"M", p.M > 0 ? json(p.M) : json()},
          {"isa", p.isa},
          {"block", p.block},
          {"precision", p.precision},
          {"threads", p.threads},
          {"granularity", p.granularity},
          {"fate", name_of(c.what)},
          {"look_s", finite(c.look_s)},
          {"rounds", c.times.size()},
          {"ratio", nullptr},
          {"low", nullptr},
          {"high", nullptr},
          {"verdict", nullptr},
          {"error", c.error.empty() ? json() : json(c.error)}};
}

json winner_json(const tune_request& r, const tune_result& result, const registry& all) {
  const tuned_time time = time_of(result);
  const point& best = result.points[*result.winner];
  return {{"candidate", *result.winner},
          {"words", profile_words(best, all)},
          {"time_s", time.seconds},
          {"low", time.bounds ? json(time.bounds->low) : json()},
          {"high", time.bounds ? json(time.bounds->high) : json()},
          {"rounds", time.rounds},
          {"command", "pairsum run " + case_options(r.levels) + " " + options_of(best, all)}};
}

}  // namespace

json tune_json(const tune_request& r, const tune_result& result, const registry& all, const std::string& profile) {
  json candidates = json::array();
  for (std::size_t k = 0; k < result.points.size(); ++k)
    candidates.push_back(candidate_json(result.points[k], result.candidates[k], all));
  if (result.winner)
    for (const rung& one : ladder_of(result)) {
      json& c = candidates[one.candidate];
      c["ratio"] = finite(one.ratio.value);
      c["low"] = one.ratio.bounds ? finite(one.ratio.bounds->low) : json();
      c["high"] = one.ratio.bounds ? finite(one.ratio.bounds->high) : json();
      c["verdict"] = word_of(one.verdict);
    }
  return {{"schema", tune_schema},
          {"environment", provenance()},
          {"case", case_json(r.levels)},
          {"n_fluid", result.points.front().n_fluid},
          {"n_boundary", result.points.front().n_boundary},
          {"phase", r.phase},
          {"binding", r.binding},
          {"budget_s", r.budget_s},
          {"prepared_s", result.prepared_s},
          {"interrupted", result.interrupted},
          {"winner", result.winner ? winner_json(r, result, all) : json()},
          {"profile", profile.empty() ? json() : json(profile)},
          {"candidates", candidates}};
}

}  // namespace pairsum::harness

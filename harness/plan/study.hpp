#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/plan/plan.hpp"

namespace pairsum::harness {

inline constexpr const char* plan_schema = "pairsum.plan/1";
inline constexpr int rounds_limit = 1000000;  ///< of a part

/// A part of a study: points that are measured interleaved, in rounds of a fresh process each.
struct part_plan {
  std::string reason;    ///< why these levels
  run_request request;   ///< its levels; `request.part` is the part's name
  int least_rounds = 6;  ///< made even if every interval is narrow (fewer only if the budget ends)
  int most_rounds = 6;
  double half_width = 0;  ///< stop when every interval's half-width is below this share of its median; 0: never
  double share = 1;       ///< weight in the distribution of the budget
};

/// A study: its question, and the parts that answer it.
struct study_plan {
  std::string study, title;
  double budget_s = 0;     ///< seconds for everything; 0: no limit
  bool peaks = false;      ///< measure bandwidth and peak first, for the model
  bool self_test = false;  ///< with the backends that test the harness
  int builds = 1;          ///< programs that are compared
  std::vector<part_plan> parts;
};

/// The plan of a JSON text:
/// {"schema","study","title","budget_s","seed","peaks","self_test","builds","defaults":{levels},
/// "parts":[{"name","reason","share","rounds","half_width", levels}]}. Levels are the words of the command line:
/// a number, a text like "5..9" or "all", or a list. Throws pairsum::error naming the key that is wrong.
/// @param cores what "all" and "cores" mean
study_plan parse_plan(const nlohmann::json& json, int cores);

/// A plan that parse_plan reads back as the same, with every default stated.
nlohmann::json plan_json(const study_plan& plan);

/// 16 hex digits that tell plans apart; the budget does not count, so that a study may be resumed with another.
std::string plan_hash(const study_plan& plan);

/// Throws pairsum::error for a plan that cannot be measured with these backends.
void check_plan(const study_plan& plan, const registry& all = registry::instance());

/// What of a plan can be measured with this build on this machine.
struct plan_here {
  study_plan plan;  ///< without what cannot, and parts of which nothing is left
  std::map<std::string, std::vector<std::string>> left_out;  ///< by part: why, a line each
};
/// Throws pairsum::error for what no build can measure.
plan_here measurable(study_plan plan, const registry& all = registry::instance());

/// The numbers of threads and precisions of a plan's points: for these the machine's peaks are measured.
std::set<std::pair<int, std::string>> peaks_of(const study_plan& plan, const registry& all);

struct shipped_plan {
  std::string_view name, json;
};
/// The plans that come with the program.
const std::vector<shipped_plan>& shipped_plans();

/// The JSON of a shipped plan, or of the file if the word ends in .json or has a slash. Throws pairsum::error that
/// lists the shipped plans, or says what is wrong with the file and where.
nlohmann::json load_plan(const std::string& word);

}  // namespace pairsum::harness
